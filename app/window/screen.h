// SPDX-License-Identifier: Apache-2.0
// Draws a picture of radiance into the window as the display shows it: the OpenColorIO view as a
// shader, exposure, channels, false colours, a second picture beside it.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "app/window/gl.h"
#include "engine/colour/display.h"
#include "engine/picture/image.h"

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

  /// RGB, [height][width][3]. Large ones are shown at a lower resolution.
  void setPicture(const float* rgb, int width, int height);
  void setOther(const float* rgb, int width, int height);
  /// Pixels of the picture, along either side, in one that is shown.
  int step() const { return kept_[0].step; }
  /// False with `error` where there is no such view; then the last one stays.
  bool setDisplay(const Display& display, std::string& error);
  void draw(const Look& look, const Sheet& sheet, int windowWidth, int windowHeight);

 private:
  struct Texture {
    GLuint name = 0;
    int width = 0, height = 0;
  };
  /// As it was given, but for its size: another view may be wanted.
  struct Kept {
    std::vector<float> rgb;
    int width = 0, height = 0, step = 1;
  };
  void keep(int which, const float* rgb, int width, int height);
  void upload(int which, const float* rgb);
  bool build(const std::string& displayed, std::string& error);

  Texture textures_[2];  ///< the picture and the other one
  Kept kept_[2];
  GLuint program_ = 0, empty_ = 0;
  Display display_;
  bool isReady_ = false;        ///< a view was chosen
  bool isByProcessor_ = false;  ///< the view needs tables: it is applied before uploading
};

/// The frame as it is on the screen: RGB, 8 bits, from the top left.
Image frame(int width, int height);

}  // namespace vestige::app
