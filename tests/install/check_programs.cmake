# Installs the programs into WORK/prefix and asks them, from a folder without sources, for what was installed with them.
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/away)
set(share ${WORK}/prefix/share/tern)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${TERN_BUILD} --prefix ${WORK}/prefix --component programs
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

# says(CODE TEXT COMMAND...): the command ends with that code and says the text.
function(says code text)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=TERN_BIN ${ARGN} WORKING_DIRECTORY ${WORK}/away
                  RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT result EQUAL code OR NOT said MATCHES "${text}")
    message(FATAL_ERROR "exit code ${result}, not ${code}, or not \"${text}\": ${ARGN}\n${said}")
  endif()
endfunction()

says(0 "goal      can be reached" ${WORK}/prefix/bin/tern-campaign check --world closing_in)
says(0 "goal      can be reached" ${share}/launch_scripts/fly.sh --check closing_in)
says(3 "there are: .*corridor_demo" ${share}/launch_scripts/fly.sh --scenario nowhere)
says(0 "plan_t" ${CMAKE_COMMAND} -E env PYTHONPATH=${share}/python python3 -c "print(__import__('tern_msgs').plan_t)")
foreach(file lcmtypes/plan_t.lcm scenarios/README.md launch_scripts/spy.sh)
  if(NOT EXISTS ${share}/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
