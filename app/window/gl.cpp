// SPDX-License-Identifier: Apache-2.0
#include "app/window/gl.h"

namespace vestige::app::gl {

#define VESTIGE_DEFINE(TYPE, Name) PFNGL##TYPE##PROC Name = nullptr;
VESTIGE_GL(VESTIGE_DEFINE)
#undef VESTIGE_DEFINE

std::string load() {
#define VESTIGE_LOAD(TYPE, Name)                                              \
  Name = reinterpret_cast<PFNGL##TYPE##PROC>(glfwGetProcAddress("gl" #Name)); \
  if (!Name) return "gl" #Name;
  VESTIGE_GL(VESTIGE_LOAD)
#undef VESTIGE_LOAD
  return "";
}

}  // namespace vestige::app::gl
