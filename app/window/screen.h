// SPDX-License-Identifier: Apache-2.0
// Draws a picture of radiance into the window as the display shows it: the OpenColorIO view as a
// shader, exposure, channels, false colours, a second picture beside it.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "app/window/gl.h"
#include "engine/image/image.h"

namespace vestige::app {

enum class Channel { all, red, green, blue, luminance, falseColour };
enum class Versus { nothing, wipe, difference };

struct Look {
  Display display;
  float gamma = 1;
  Channel channel = Channel::all;
  bool isData = false;  ///< numbers, not light: shown as they are
  Versus versus = Versus::nothing;
  float wipe = 0.5f;  ///< share of the picture on whose right the other one is shown
};

/// Where the picture lies in the window, in its pixels from the top left.
struct Sheet {
  float left = 0, top = 0, zoom = 1;  ///< window pixels a picture pixel
  int width = 0, height = 0;          ///< of the film, pixels
  /// Of the film that the picture holds: left, top, right, bottom as shares.
  std::array<float, 4> part = {0, 0, 1, 1};
};

/// [the thread of the window, with its OpenGL context, while it lives]
class Screen {
 public:
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// RGB, [height][width][3]. Larger ones than the driver takes are shown at a lower resolution.
  void setPicture(const float* rgb, int width, int height);
  void setOther(const float* rgb, int width, int height);
  /// False with `error` where there is no such view; then the last one stays.
  bool setDisplay(const Display& display, std::string& error);
  void draw(const Look& look, const Sheet& sheet, int windowWidth, int windowHeight);

 private:
  struct Texture {
    GLuint name = 0;
    int width = 0, height = 0;
  };
  void upload(Texture& texture, const float* rgb, int width, int height);
  bool build(const std::string& displayed, std::string& error);

  Texture picture_, other_;
  GLuint program_ = 0, empty_ = 0;
  Display display_;
  bool isReady_ = false;        ///< a view was chosen
  bool isByProcessor_ = false;  ///< the view needs tables: it is applied before uploading
  std::vector<float> kept_[2];  ///< of that case, so that another exposure can be shown
  int keptSize_[2][2] = {};
};

/// The frame as it is on the screen: RGB, 8 bits, from the top left.
Image frame(int width, int height);

}  // namespace vestige::app
