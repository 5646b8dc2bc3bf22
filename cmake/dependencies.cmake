# SPDX-License-Identifier: Apache-2.0
# Everything comes from the distribution's packages; Debian 12 and 13 are the ones tried.
find_package(Threads REQUIRED)
find_package(embree CONFIG REQUIRED)  # 3 or 4, target `embree`
find_package(fmt CONFIG REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
# By pkg-config: the CMake packages of these two want tools that Debian packages apart.
find_package(PkgConfig REQUIRED)
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO>=2.4)
pkg_check_modules(OpenColorIO REQUIRED IMPORTED_TARGET OpenColorIO>=2.1)
pkg_check_modules(assimp REQUIRED IMPORTED_TARGET assimp>=5.2)
if(VESTIGE_TESTS)
  find_package(Catch2 REQUIRED)  # 2 or 3
endif()
