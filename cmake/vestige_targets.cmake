# SPDX-License-Identifier: Apache-2.0
# How the parts of the house are declared: a folder is a target.

# Flags that every target of ours is compiled with.
add_library(vestige_flags INTERFACE)
target_compile_options(vestige_flags INTERFACE -Wall -Wextra -ffp-contract=off -fno-math-errno)
if(VESTIGE_DOUBLE)
  target_compile_definitions(vestige_flags INTERFACE VESTIGE_DOUBLE)
  # A note of gcc about vectors of four doubles; none crosses a library boundary.
  target_compile_options(vestige_flags INTERFACE -Wno-psabi)
endif()
if(VESTIGE_SANITIZE)
  target_compile_options(vestige_flags INTERFACE -fsanitize=${VESTIGE_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(vestige_flags INTERFACE -fsanitize=${VESTIGE_SANITIZE})
endif()

# A static library of all .cpp files in this folder: vestige_part(vestige_lang vestige_sdk fmt::fmt)
function(vestige_part name)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(NOT sources)
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE vestige_flags ${ARGN})
    return()
  endif()
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} PUBLIC vestige_flags ${ARGN})
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
endfunction()

# The plugin KIND_NAME in plugins/KIND/NAME.cpp (or the folder plugins/KIND/NAME/), linked with the
# SDK and whatever LIBRARIES it brings itself.
function(vestige_plugin kind name)
  cmake_parse_arguments(arg "" "" "LIBRARIES" ${ARGN})
  set(target ${kind}_${name})
  set(path ${CMAKE_CURRENT_SOURCE_DIR}/${kind}/${name})
  if(IS_DIRECTORY ${path})
    file(GLOB sources CONFIGURE_DEPENDS ${path}/*.cpp)
  else()
    set(sources ${path}.cpp)
  endif()
  add_library(${target} MODULE ${sources})
  target_link_libraries(${target} PRIVATE vestige_sdk vestige_flags ${arg_LIBRARIES})
  target_link_options(${target} PRIVATE -Wl,--no-undefined)
  if(VESTIGE_SANITIZE)  # the runtime is the host's
    target_link_options(${target} PRIVATE -Wl,-z,undefs)
  endif()
  set_target_properties(${target} PROPERTIES PREFIX ""
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/${VESTIGE_PLUGIN_DIR})
  install(TARGETS ${target} LIBRARY DESTINATION ${VESTIGE_PLUGIN_DIR})
  set_property(GLOBAL APPEND PROPERTY VESTIGE_PLUGINS ${target})
endfunction()
