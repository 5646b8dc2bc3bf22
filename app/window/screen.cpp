// SPDX-License-Identifier: Apache-2.0
#include "app/window/screen.h"

#include <algorithm>
#include <cmath>

namespace vestige::app {
namespace {

constexpr double kMostTexels = double(1 << 25);  ///< of a texture: 0.4 GB, four times a 4K display

constexpr const char* kVertex = R"(#version 150
void main() {  // one triangle over everything
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

constexpr const char* kHead = "#version 150\n";

constexpr const char* kFragment = R"(
uniform sampler2D picture, other;
uniform vec2 corner, size;  // of the sheet: window pixels from the top left; film pixels
uniform vec2 low, high;     // the part of the film that the picture holds, as shares
uniform float zoom, windowHeight, exposure, gamma, wipe;
uniform int channel, isData, versus;
out vec4 result;

// At a share of a picture: a pixel as it is where pixels are large, else a mean of some.
vec3 lookUp(sampler2D from, vec2 share) {
  if (zoom < 1.0) return texture(from, share).rgb;
  ivec2 n = textureSize(from, 0);
  return texelFetch(from, clamp(ivec2(floor(share * vec2(n))), ivec2(0), n - 1), 0).rgb;
}
float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

// Blue at 1/64, green at 1/4, red at 16, in steps of a stop; white beyond.
vec3 falseColour(float x) {
  float t = clamp((floor(log2(max(x, 1e-9))) + 8.0) / 12.0, 0.0, 1.0);
  return clamp(vec3(1.5 - abs(4.0 * t - 3.0), 1.5 - abs(4.0 * t - 2.0), 1.5 - abs(4.0 * t - 1.0)),
               0.0, 1.0);
}

vec3 shown(vec3 c) {
  if (isData != 0) return c;
  c *= exposure;
  if (channel == 1) c = c.rrr;
  if (channel == 2) c = c.ggg;
  if (channel == 3) c = c.bbb;
  if (channel == 4) c = vec3(luminance(c));
  if (channel == 5) return falseColour(luminance(c));
  c = displayed(vec4(c, 1.0)).rgb;
  return gamma == 1.0 ? c : pow(max(c, 0.0), vec3(1.0 / gamma));
}

void main() {
  vec2 window = vec2(gl_FragCoord.x, windowHeight - gl_FragCoord.y);
  vec2 at = (window - corner) / zoom;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, size))) {
    result = vec4(vec3(0.09), 1.0);
    return;
  }
  vec2 share = at / size, inside = (share - low) / (high - low);
  bool isIn = all(greaterThanEqual(inside, vec2(0.0))) && all(lessThan(inside, vec2(1.0)));
  vec3 c = isIn ? lookUp(picture, inside) : vec3(0.0);
  if (versus == 2)
    c = isIn ? shown(abs(c - lookUp(other, share))) : vec3(0.0);
  else if (versus == 1 && abs(at.x - wipe * size.x) * zoom < 0.75)
    c = vec3(1.0, 0.8, 0.2);
  else if (versus == 1 && at.x > wipe * size.x)
    c = shown(lookUp(other, share));
  else
    c = isIn ? shown(c) : vec3(0.05);
  result = vec4(clamp(c, 0.0, 1.0), 1.0);
}
)";

constexpr const char* kUnchanged = "vec4 displayed(vec4 c) { return c; }\n";

GLuint compiled(GLenum kind, const std::string& text, std::string& error) {
  const GLuint shader = gl::CreateShader(kind);
  const char* lines = text.c_str();
  gl::ShaderSource(shader, 1, &lines, nullptr);
  gl::CompileShader(shader);
  GLint fine = 0;
  gl::GetShaderiv(shader, GL_COMPILE_STATUS, &fine);
  if (fine) return shader;
  char log[1024] = "";
  gl::GetShaderInfoLog(shader, sizeof log, nullptr, log);
  error = log;
  gl::DeleteShader(shader);
  return 0;
}

/// Means of `step` x `step` pixels.
std::vector<float> smaller(const float* rgb, int width, int height, int step) {
  const int w = (width + step - 1) / step, h = (height + step - 1) / step;
  std::vector<float> means(std::size_t(w) * h * 3);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const int x1 = std::min(width, (x + 1) * step), y1 = std::min(height, (y + 1) * step);
      float* to = &means[(std::size_t(y) * w + x) * 3];
      for (int j = y * step; j < y1; ++j)
        for (int i = x * step; i < x1; ++i)
          for (int c = 0; c < 3; ++c) to[c] += rgb[(std::size_t(j) * width + i) * 3 + c];
      for (int c = 0; c < 3; ++c) to[c] /= float((x1 - x * step) * (y1 - y * step));
    }
  return means;
}

}  // namespace

Screen::Screen() {
  gl::GenVertexArrays(1, &empty_);
  std::string ignored;
  build(kUnchanged, ignored);
}

Screen::~Screen() {
  for (const Texture& t : textures_)
    if (t.name) gl::DeleteTextures(1, &t.name);
  if (program_) gl::DeleteProgram(program_);
  gl::DeleteVertexArrays(1, &empty_);
}

void Screen::upload(int which, const float* rgb) {
  Texture& texture = textures_[which];
  const Kept& kept = kept_[which];
  gl::ActiveTexture(GL_TEXTURE0);
  gl::PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  const bool isNew = texture.name == 0;
  if (isNew) gl::GenTextures(1, &texture.name);
  gl::BindTexture(GL_TEXTURE_2D, texture.name);
  if (isNew) {
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  if (isNew || kept.width != texture.width || kept.height != texture.height)
    gl::TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, kept.width, kept.height, 0, GL_RGB, GL_FLOAT, rgb);
  else
    gl::TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kept.width, kept.height, GL_RGB, GL_FLOAT, rgb);
  texture.width = kept.width, texture.height = kept.height;
}

void Screen::keep(int which, const float* rgb, int width, int height) {
  GLint most = 1;
  gl::GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  const double texels = double(width) * height;
  const int step = std::max((std::max(width, height) + most - 1) / most,
                            int(std::ceil(std::sqrt(texels / kMostTexels))));
  Kept& kept = kept_[which];
  kept.width = (width + step - 1) / step, kept.height = (height + step - 1) / step;
  kept.step = step;
  if (step > 1)
    kept.rgb = smaller(rgb, width, height, step);
  else
    kept.rgb.assign(rgb, rgb + std::size_t(width) * height * 3);
  std::string ignored;
  if (isByProcessor_) setDisplay(display_, ignored);
  if (!isByProcessor_) upload(which, kept.rgb.data());
}

void Screen::setPicture(const float* rgb, int width, int height) { keep(0, rgb, width, height); }
void Screen::setOther(const float* rgb, int width, int height) { keep(1, rgb, width, height); }

bool Screen::setDisplay(const Display& display, std::string& error) {
  const bool isSameView =
      isReady_ && display.view == display_.view && display.display == display_.display;
  if (isSameView && !isByProcessor_) return true;  // exposure is a number of the shader
  std::string why;
  const std::string shader = displayShader(display, why);
  const bool isShader = !shader.empty() && build(shader, why);
  float one[3] = {1, 1, 1};  // tells whether there is such a view
  if (!isShader && !applyDisplay(display, one, 1, 3, error)) return false;
  for (int i = 0; i < 2 && (!isShader || isByProcessor_); ++i) {
    if (kept_[i].rgb.empty()) continue;
    std::vector<float> pixels = kept_[i].rgb;
    if (!isShader && !applyDisplay(display, pixels.data(), pixels.size() / 3, 3, error))
      return false;
    upload(i, pixels.data());
  }
  if (!isShader) build(kUnchanged, error);
  isByProcessor_ = !isShader;
  display_ = display, isReady_ = true;
  return true;
}

bool Screen::build(const std::string& displayed, std::string& error) {
  const GLuint vertex = compiled(GL_VERTEX_SHADER, kVertex, error);
  const GLuint fragment = compiled(GL_FRAGMENT_SHADER, kHead + displayed + kFragment, error);
  if (!vertex || !fragment) return false;
  const GLuint program = gl::CreateProgram();
  gl::AttachShader(program, vertex);
  gl::AttachShader(program, fragment);
  gl::LinkProgram(program);
  gl::DeleteShader(vertex);
  gl::DeleteShader(fragment);
  GLint fine = 0;
  gl::GetProgramiv(program, GL_LINK_STATUS, &fine);
  if (!fine) {
    char log[1024] = "";
    gl::GetProgramInfoLog(program, sizeof log, nullptr, log);
    error = log;
    gl::DeleteProgram(program);
    return false;
  }
  if (program_) gl::DeleteProgram(program_);
  program_ = program;
  return true;
}

void Screen::draw(const Look& look, const Sheet& sheet, int windowWidth, int windowHeight) {
  gl::Viewport(0, 0, windowWidth, windowHeight);
  gl::Disable(GL_BLEND);
  gl::Disable(GL_SCISSOR_TEST);
  const GLuint picture = textures_[0].name, other = textures_[1].name;
  if (!program_ || !picture) {
    gl::ClearColor(0.09f, 0.09f, 0.09f, 1);
    gl::Clear(GL_COLOR_BUFFER_BIT);
    return;
  }
  gl::UseProgram(program_);
  const auto place = [&](const char* name) { return gl::GetUniformLocation(program_, name); };
  gl::ActiveTexture(GL_TEXTURE1);
  gl::BindTexture(GL_TEXTURE_2D, other ? other : picture);
  gl::ActiveTexture(GL_TEXTURE0);
  gl::BindTexture(GL_TEXTURE_2D, picture);
  gl::Uniform1i(place("picture"), 0);
  gl::Uniform1i(place("other"), 1);
  gl::Uniform2f(place("corner"), sheet.left, sheet.top);
  gl::Uniform2f(place("size"), float(sheet.width), float(sheet.height));
  gl::Uniform2f(place("low"), sheet.part[0], sheet.part[1]);
  gl::Uniform2f(place("high"), sheet.part[2], sheet.part[3]);
  gl::Uniform1f(place("zoom"), sheet.zoom);
  gl::Uniform1f(place("windowHeight"), float(windowHeight));
  gl::Uniform1f(place("exposure"), isByProcessor_ ? 1 : float(std::exp2(look.display.exposure)));
  gl::Uniform1f(place("gamma"), look.gamma);
  gl::Uniform1f(place("wipe"), look.wipe);
  gl::Uniform1i(place("channel"), int(look.channel));
  gl::Uniform1i(place("isData"), look.isData);
  gl::Uniform1i(place("versus"), other ? int(look.versus) : 0);
  gl::BindVertexArray(empty_);
  gl::DrawArrays(GL_TRIANGLES, 0, 3);
  gl::BindVertexArray(0);
  gl::UseProgram(0);
}

Image frame(int width, int height) {
  std::vector<unsigned char> bytes(std::size_t(width) * height * 3);
  gl::PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl::ReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
  Image image;
  image.width = width, image.height = height, image.channels = {"R", "G", "B"};
  image.pixels.resize(bytes.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < 3 * width; ++x)
      image.pixels[std::size_t(y) * width * 3 + x] =
          float(bytes[std::size_t(height - 1 - y) * width * 3 + x]) / 255;
  return image;
}

}  // namespace vestige::app
