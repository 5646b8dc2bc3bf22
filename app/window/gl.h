// SPDX-License-Identifier: Apache-2.0
// The few functions of OpenGL 3.3 that the window uses, found at run time through GLFW.
#pragma once
#define GLFW_INCLUDE_NONE
#include <GL/glcorearb.h>
#include <GLFW/glfw3.h>

#include <string>

namespace vestige::app::gl {

#define VESTIGE_GL(F)                       \
  F(VIEWPORT, Viewport)                     \
  F(CLEARCOLOR, ClearColor)                 \
  F(CLEAR, Clear)                           \
  F(GENTEXTURES, GenTextures)               \
  F(DELETETEXTURES, DeleteTextures)         \
  F(BINDTEXTURE, BindTexture)               \
  F(ACTIVETEXTURE, ActiveTexture)           \
  F(TEXPARAMETERI, TexParameteri)           \
  F(PIXELSTOREI, PixelStorei)               \
  F(TEXIMAGE2D, TexImage2D)                 \
  F(TEXSUBIMAGE2D, TexSubImage2D)           \
  F(GENVERTEXARRAYS, GenVertexArrays)       \
  F(DELETEVERTEXARRAYS, DeleteVertexArrays) \
  F(BINDVERTEXARRAY, BindVertexArray)       \
  F(DRAWARRAYS, DrawArrays)                 \
  F(CREATESHADER, CreateShader)             \
  F(SHADERSOURCE, ShaderSource)             \
  F(COMPILESHADER, CompileShader)           \
  F(GETSHADERIV, GetShaderiv)               \
  F(GETSHADERINFOLOG, GetShaderInfoLog)     \
  F(DELETESHADER, DeleteShader)             \
  F(CREATEPROGRAM, CreateProgram)           \
  F(ATTACHSHADER, AttachShader)             \
  F(LINKPROGRAM, LinkProgram)               \
  F(GETPROGRAMIV, GetProgramiv)             \
  F(GETPROGRAMINFOLOG, GetProgramInfoLog)   \
  F(USEPROGRAM, UseProgram)                 \
  F(DELETEPROGRAM, DeleteProgram)           \
  F(GETUNIFORMLOCATION, GetUniformLocation) \
  F(UNIFORM1I, Uniform1i)                   \
  F(UNIFORM1F, Uniform1f)                   \
  F(UNIFORM2F, Uniform2f)                   \
  F(READPIXELS, ReadPixels)                 \
  F(DISABLE, Disable)                       \
  F(GETINTEGERV, GetIntegerv)

#define VESTIGE_DECLARE(TYPE, Name) extern PFNGL##TYPE##PROC Name;
VESTIGE_GL(VESTIGE_DECLARE)
#undef VESTIGE_DECLARE

/// Of the current context; "" or the function that it lacks.
std::string load();

}  // namespace vestige::app::gl
