// SPDX-License-Identifier: Apache-2.0
#include "app/window/gl.h"

#ifdef VESTIGE_KEEPS_DRIVER
#include <dlfcn.h>
#include <link.h>
#endif

namespace vestige::app::gl {

#define VESTIGE_DEFINE(TYPE, Name) PFNGL##TYPE##PROC Name = nullptr;
VESTIGE_GL(VESTIGE_DEFINE)
#undef VESTIGE_DEFINE

namespace {

/// For the leak sanitizer: what a driver's own variables point to would count as lost once GLFW
/// unloads the driver, and nothing could tell whose it was.
void keepDriver() {
#ifdef VESTIGE_KEEPS_DRIVER
  const auto keep = [](dl_phdr_info* module, std::size_t, void*) {
    if (*module->dlpi_name) dlopen(module->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
    return 0;
  };
  dl_iterate_phdr(keep, nullptr);
#endif
}

}  // namespace

std::string load() {
  keepDriver();
#define VESTIGE_LOAD(TYPE, Name)                                              \
  Name = reinterpret_cast<PFNGL##TYPE##PROC>(glfwGetProcAddress("gl" #Name)); \
  if (!Name) return "gl" #Name;
  VESTIGE_GL(VESTIGE_LOAD)
#undef VESTIGE_LOAD
  return "";
}

}  // namespace vestige::app::gl
