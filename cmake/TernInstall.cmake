# `cmake --install`: the programs with tern-viewer's page, if it was built; what they fly and the scripts (share/tern);
# the messages for other languages; the libraries (TernPackage.cmake).
include(TernPackage)

# Programs are the executables named tern-…; tests and benchmarks stay behind. `apps` builds them all.
add_custom_target(apps)
get_property(executables GLOBAL PROPERTY TERN_EXECUTABLES)
foreach(program ${executables})
  if(program MATCHES "^tern-")
    add_dependencies(apps ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
  endif()
endforeach()

# What every flight needs: fly.sh builds no more. Its options add their own programs (launch_scripts/fly.sh).
add_custom_target(flight)
add_dependencies(flight tern-launch tern-simulator tern-predictor tern-planner tern-executor tern-mapper tern-monitor
                 tern-logger)

# The scripts find programs and scenarios from their own place (launch_scripts/lib.sh).
foreach(folder scenarios launch_scripts lcmtypes)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION share/tern COMPONENT programs USE_SOURCE_PERMISSIONS
          PATTERN CMakeLists.txt EXCLUDE PATTERN build.sh EXCLUDE PATTERN test.sh EXCLUDE PATTERN install.sh EXCLUDE
          PATTERN record_golden.sh EXCLUDE PATTERN results.sh EXCLUDE PATTERN view_page.sh EXCLUDE
          PATTERN python.sh EXCLUDE
          PATTERN campaign_slurm.sh EXCLUDE PATTERN packages*.txt EXCLUDE)
endforeach()
# The command `tern`.
install(CODE "file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}\")
file(CREATE_LINK ../share/tern/launch_scripts/tern.sh
  \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}/tern\" SYMBOLIC)" COMPONENT programs)
install(DIRECTORY ${PROJECT_BINARY_DIR}/python/tern_msgs DESTINATION share/tern/python COMPONENT programs OPTIONAL)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/docs/licensing.md DESTINATION share/doc/tern
        COMPONENT programs)
# Pages of docs/howto/ use them on vehicles that have no sources.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/examples DESTINATION share/doc/tern COMPONENT programs
        PATTERN __pycache__ EXCLUDE)
