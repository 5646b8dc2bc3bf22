# SPDX-License-Identifier: Apache-2.0
# What others need to build plugins: a CMake package and a pkg-config file, relocatable. They are
# made where they would be installed, beside headers and templates, so that the build folder can be
# used like an installation.
include(CMakePackageConfigHelpers)
file(READ ${CMAKE_SOURCE_DIR}/engine/sdk/vestige/abi.h abi)
if(NOT abi MATCHES "kSdkMajor = ([0-9]+), kSdkMinor = ([0-9]+)")
  message(FATAL_ERROR "engine/sdk/vestige/abi.h does not say kSdkMajor and kSdkMinor any more")
endif()
set(VESTIGE_SDK_MAJOR ${CMAKE_MATCH_1})
set(VESTIGE_SDK_VERSION ${CMAKE_MATCH_1}.${CMAKE_MATCH_2})
set(VESTIGE_PACKAGE_VERSION 1.${VESTIGE_SDK_VERSION})
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS engine/sdk/vestige/abi.h)

if(VESTIGE_DOUBLE)
  set(VESTIGE_EXTRA_DEFINITIONS VESTIGE_DOUBLE)
  set(VESTIGE_EXTRA_OPTIONS ";-Wno-psabi")
  set(VESTIGE_PC_FLAGS " -Wno-psabi -DVESTIGE_DOUBLE")
endif()

set(package lib/cmake/Vestige)
configure_file(cmake/package/VestigeConfig.cmake.in ${package}/VestigeConfig.cmake @ONLY)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/${package}/VestigeConfigVersion.cmake
  VERSION ${VESTIGE_PACKAGE_VERSION} COMPATIBILITY SameMajorVersion)
configure_file(cmake/package/vestige.pc.in lib/pkgconfig/vestige.pc @ONLY)
install(DIRECTORY ${CMAKE_BINARY_DIR}/${package}/ DESTINATION ${package})
install(FILES ${CMAKE_BINARY_DIR}/lib/pkgconfig/vestige.pc DESTINATION lib/pkgconfig)

file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/include ${CMAKE_BINARY_DIR}/${VESTIGE_SHARE_DIR})
file(CREATE_LINK ${CMAKE_SOURCE_DIR}/engine/sdk/vestige ${CMAKE_BINARY_DIR}/include/vestige SYMBOLIC)
file(CREATE_LINK ${CMAKE_SOURCE_DIR}/app/templates ${CMAKE_BINARY_DIR}/${VESTIGE_SHARE_DIR}/templates SYMBOLIC)

install(DIRECTORY app/templates DESTINATION ${VESTIGE_SHARE_DIR})
# The pages lie as they do in the checkout, so that the links between them work. Headers and
# examples are installed elsewhere; symbolic links relative to the pages lead there.
set(pages share/doc/vestige)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE DESTINATION ${pages})
install(DIRECTORY docs DESTINATION ${pages}
  PATTERN docs/figures EXCLUDE PATTERN docs/reference/make EXCLUDE PATTERN "*.py" EXCLUDE)
install(FILES bench/README.md DESTINATION ${pages}/bench)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/pages/engine/sdk)
file(CREATE_LINK ../../../../../include/vestige ${CMAKE_BINARY_DIR}/pages/engine/sdk/vestige SYMBOLIC)
file(CREATE_LINK ../../vestige/examples ${CMAKE_BINARY_DIR}/pages/examples SYMBOLIC)
install(DIRECTORY ${CMAKE_BINARY_DIR}/pages/ DESTINATION ${pages})
