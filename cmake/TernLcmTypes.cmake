# tern_lcm_types(NAME FILES...): C++ types of .lcm files by lcm-gen, as a SYSTEM interface library.
find_program(LCM_GEN lcm-gen REQUIRED)
function(tern_lcm_types name)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/generated)
  set(headers "")
  foreach(file ${ARGN})
    get_filename_component(stem ${file} NAME_WE)
    list(APPEND headers ${out}/tern_msgs/${stem}.hpp)
  endforeach()
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE inputs)
  add_custom_command(OUTPUT ${headers}
    COMMAND ${LCM_GEN} -x --cpp-std=c++11 --cpp-hpath ${out} ${inputs}
    DEPENDS ${inputs} VERBATIM)
  add_custom_target(${name}_generate DEPENDS ${headers})
  add_library(${name} INTERFACE)
  add_dependencies(${name} ${name}_generate)
  target_include_directories(${name} SYSTEM INTERFACE ${out})
  target_link_libraries(${name} INTERFACE PkgConfig::LCM)
endfunction()

# tern_python_types(NAME FILES...): the same types as the Python package tern_msgs in <build>/python, which needs no LCM.
function(tern_python_types name)
  set(out ${PROJECT_BINARY_DIR}/python)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE inputs)
  add_custom_command(OUTPUT ${out}/tern_msgs/__init__.py
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${out}/tern_msgs
    COMMAND ${LCM_GEN} -p --ppath ${out} ${inputs}
    DEPENDS ${inputs} VERBATIM)
  add_custom_target(${name} ALL DEPENDS ${out}/tern_msgs/__init__.py)
endfunction()
