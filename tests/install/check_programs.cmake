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
says(0 "goal      can be reached" ${WORK}/prefix/bin/tern check closing_in)
says(3 "there is no program tern-nonsense" ${WORK}/prefix/bin/tern nonsense)
says(3 "there are: .*corridor_demo" ${share}/launch_scripts/fly.sh --scenario nowhere)
says(0 "plan_t" ${CMAKE_COMMAND} -E env PYTHONPATH=${share}/python python3 -c "print(__import__('tern_msgs').plan_t)")
# No program is linked with Ipopt. Its plug-in is a component of its own; a scenario that asks for it is refused without.
file(GLOB programs ${WORK}/prefix/bin/tern-*)
foreach(program ${programs})
  execute_process(COMMAND readelf -d ${program} OUTPUT_VARIABLE needed COMMAND_ERROR_IS_FATAL ANY)
  if(needed MATCHES "ipopt")
    message(FATAL_ERROR "${program} is linked with Ipopt:\n${needed}")
  endif()
endforeach()
set(by_ipopt ${WORK}/prefix/bin/tern-campaign check --world closing_in --set)
says(2 "planner.optimization.solver: needs Ipopt. tern-ipopt.so is not installed" ${by_ipopt} planner.optimization.solver=ipopt)
says(2 "planner.optimization.method: needs Ipopt. tern-ipopt.so is not installed" ${by_ipopt} planner.optimization.method=joint)
says(0 "goal      can be reached" ${by_ipopt} planner.optimization.method=search_only)
file(WRITE ${WORK}/away/tern-ipopt.so "a file of that name in the current folder is not Tern's")
says(2 "tern-ipopt.so is not installed" ${CMAKE_COMMAND} -E env PATH=${WORK}/prefix/bin tern-campaign check
     --world closing_in --set planner.optimization.solver=ipopt)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${TERN_BUILD} --prefix ${WORK}/prefix --component ipopt
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
says(0 "goal      can be reached" ${by_ipopt} planner.optimization.solver=ipopt)

foreach(file lcmtypes/plan_t.lcm scenarios/README.md launch_scripts/spy.sh)
  if(NOT EXISTS ${share}/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
