// SPDX-License-Identifier: Apache-2.0
// What keys and the mouse do to the window; docs/window.md has the list.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/window/layers.h"
#include "app/window/window.h"

namespace vestige::app {
namespace {

constexpr Real kTurn = Real(0.006);      ///< radians a pixel of an ordinary display
constexpr double kClick = 4, kGrip = 8;  ///< such pixels: a click may move; beside a wipe
constexpr Real kCloser = Real(0.88);     ///< a notch of the wheel
constexpr Real kStep = Real(0.8);        ///< of the distance to look_at, a second of walking
constexpr double kUndoPause = 0.5;       ///< seconds that part two movements
constexpr std::size_t kMostUndo = 200;

}  // namespace

void Window::restart(int& counter) {
  ++counter;
  if (asked_ < 0) asked_ = glfwGetTime();
  if (preview_) preview_->want(wish_);
  isDirty_ = true;
}

void Window::useCamera(Block camera) {
  wish_.camera = std::move(camera);
  restart(wish_.view);
}

/// One step back for each movement, not for each of its events.
void Window::keepForUndo() {
  const double now = glfwGetTime();
  if (now - lastUndo_ > kUndoPause) undo_.push_back(wish_.camera);
  lastUndo_ = now;
  if (undo_.size() > kMostUndo) undo_.pop_front();
}

void Window::undo() {
  if (undo_.empty()) return say("nothing to undo");
  wish_.camera = undo_.back();
  undo_.pop_back();
  lastUndo_ = -1;
  restart(wish_.view);
}

void Window::steer(const View& view) {
  keepForUndo();
  useCamera(withView(*camera(), cameraSchema(), view));
}

void Window::takeNextIntegrator() {
  if (!open_ || !snapshot_ || open_->integrators.empty()) return;
  const std::vector<std::string>& all = open_->integrators;
  std::string& wanted = wish_.build.integrator;
  const std::string now = wanted.empty() ? snapshot_->integrator : wanted;
  const auto at = std::find(all.begin(), all.end(), now);
  wanted = at == all.end() || at + 1 == all.end() ? all.front() : *(at + 1);
  say("integrator " + wanted);
  restart(wish_.way);
}

void Window::onKey(int key, int mods) {
  const bool isControl = mods & GLFW_MOD_CONTROL;
  switch (key) {
    case GLFW_KEY_ESCAPE:
      if (inspection_ || isRegion_ || isPicking_) {
        if (preview_) preview_->forgetInspection();
        inspection_.reset(), isRegion_ = isPicking_ = false;
      } else if (wish_.region)
        wish_.region.reset(), restart(wish_.picture);
      break;
    case GLFW_KEY_Q:
      if (isControl) glfwSetWindowShouldClose(window_, GLFW_TRUE);
      break;
    case GLFW_KEY_Z:
      undo();
      break;
    case GLFW_KEY_HOME:
      if (wish_.camera) keepForUndo(), wish_.camera.reset(), restart(wish_.view);
      break;
    case GLFW_KEY_C:
      if (const auto c = camera()) {
        glfwSetClipboardString(window_, cameraText(placed(*c, cameraSchema())).c_str());
        say("the camera is in the clipboard, as text for the scene");
      }
      break;
    case GLFW_KEY_N:
      takeNextIntegrator();
      break;
    case GLFW_KEY_SPACE:
      wish_.isPaused = !wish_.isPaused;
      if (preview_) preview_->want(wish_);
      break;
    case GLFW_KEY_R:
      isRegion_ = true;
      say("drag over the part of the picture that is to be rendered; Escape: all of it");
      break;
    case GLFW_KEY_F:
      isPicking_ = true;
      say("click at what is to be sharp, and to turn around");
      break;
    case GLFW_KEY_F5:
      readAgain();
      break;
    case GLFW_KEY_F12:
      wantsShot_ = true;
      break;
    case GLFW_KEY_TAB:
      hidesPanels_ = !hidesPanels_;
      break;
    case GLFW_KEY_H:
    case GLFW_KEY_F1:
      showsHelp_ = !showsHelp_;
      break;
    case GLFW_KEY_0:
      isFitted_ = true;
      break;
    case GLFW_KEY_1:
      isFitted_ = false, sheet_.zoom = 1;
      break;
    case GLFW_KEY_B:
      keepAsOther();
      break;
    case GLFW_KEY_V:
      look_.versus = Versus((int(look_.versus) + 1) % 3);
      break;
    case GLFW_KEY_P:
      savePicture(file_[0] ? file_ : "");
      break;
    case GLFW_KEY_COMMA:
    case GLFW_KEY_PERIOD: {
      look_.display.exposure += key == GLFW_KEY_PERIOD ? 0.5 : -0.5;
      std::string error;
      screen_->setDisplay(look_.display, error);
      break;
    }
    default:
      break;
  }
}

void Window::walkByKeys(double seconds) {
  if (ImGui::GetIO().WantCaptureKeyboard) return;
  const auto isDown = [&](int key) { return glfwGetKey(window_, key) == GLFW_PRESS; };
  if (isDown(GLFW_KEY_LEFT_CONTROL) || isDown(GLFW_KEY_RIGHT_CONTROL)) return;
  std::vector<int> down;
  for (const int key : {GLFW_KEY_W, GLFW_KEY_S, GLFW_KEY_A, GLFW_KEY_D, GLFW_KEY_E, GLFW_KEY_X})
    if (isDown(key)) down.push_back(key);
  if (!down.empty()) walk(down, seconds);
}

void Window::walk(const std::vector<int>& keys, double seconds) {
  const auto block = camera();
  if (!block) return;
  const auto view = viewOf(*block, cameraSchema());
  if (!view) return;
  const auto count = [&](int key) { return Real(std::count(keys.begin(), keys.end(), key)); };
  const Real step = kStep * distance(*view) * Real(seconds);
  const Vec3 by =
      step * Vec3{count(GLFW_KEY_D) - count(GLFW_KEY_A), count(GLFW_KEY_E) - count(GLFW_KEY_X),
                  count(GLFW_KEY_W) - count(GLFW_KEY_S)};
  if (lengthSquared(by) > 0) steer(pan(app::walk(*view, by.z), by.x, by.y));
}

void Window::onButton(int button, bool isDown, int mods) {
  const auto [x, y] = cursor();
  if (isDown) {
    button_ = button, isDragged_ = false;
    downX_ = lastX_ = x, downY_ = lastY_ = y;
    if (mods & GLFW_MOD_SHIFT && button == GLFW_MOUSE_BUTTON_LEFT)
      button_ = GLFW_MOUSE_BUTTON_MIDDLE;
    if (mods & GLFW_MOD_CONTROL && button == GLFW_MOUSE_BUTTON_LEFT)
      button_ = GLFW_MOUSE_BUTTON_LAST;  // moves the sheet
    const auto at = pixelAt(x, y);
    isWipe_ =
        look_.versus == Versus::wipe && other_.width > 0 && at &&
        std::abs(double(at->x) - look_.wipe * sheet_.width) * sheet_.zoom < kGrip * fineness();
    return;
  }
  if (button_ < 0) return;
  const bool wasDragged = isDragged_;
  button_ = -1, isDragged_ = false;
  if (isWipe_) {
    isWipe_ = false;
    return;
  }
  if (isRegion_) {
    isRegion_ = false;
    if (!wasDragged) return;
    const auto share = [](double at, double corner, double size) {
      return std::clamp((at - corner) / std::max(1.0, size), 0.0, 1.0);
    };
    const double wide = sheet_.zoom * sheet_.width, high = sheet_.zoom * sheet_.height;
    const double x0 = share(std::min(x, downX_), sheet_.left, wide),
                 y0 = share(std::min(y, downY_), sheet_.top, high),
                 x1 = share(std::max(x, downX_), sheet_.left, wide),
                 y1 = share(std::max(y, downY_), sheet_.top, high);
    if (x1 > x0 && y1 > y0) {
      wish_.region = std::array<double, 4>{x0, y0, x1, y1};
      restart(wish_.picture);
    }
    return;
  }
  if (!wasDragged && button == GLFW_MOUSE_BUTTON_LEFT) click(x, y);
}

void Window::onMove(double x, double y) {
  const double dx = x - lastX_, dy = y - lastY_;
  if (button_ < 0) return;
  if (std::hypot(x - downX_, y - downY_) > kClick * fineness()) isDragged_ = true;
  if (!isDragged_) return;
  lastX_ = x, lastY_ = y;
  if (isWipe_) {
    if (sheet_.width > 0)
      look_.wipe = float(std::clamp((x - sheet_.left) / sheet_.zoom / sheet_.width, 0.0, 1.0));
    return;
  }
  if (isRegion_) return;
  if (button_ == GLFW_MOUSE_BUTTON_LAST || request_.isPicture) {
    isFitted_ = false;
    sheet_.left += float(dx), sheet_.top += float(dy);
    return;
  }
  const auto block = camera();
  if (!block) return;
  const auto view = viewOf(*block, cameraSchema());
  if (!view) return say("camera " + block->plugin + " has no location and look_at to move");
  const Real perUnit = kTurn / Real(fineness());
  if (button_ == GLFW_MOUSE_BUTTON_MIDDLE) {
    const Real perPixel =
        distance(*view) / Real(std::max(100.f, sheet_.zoom * float(sheet_.width)));
    steer(pan(*view, -Real(dx) * perPixel, Real(dy) * perPixel));
  } else if (button_ == GLFW_MOUSE_BUTTON_RIGHT) {
    steer(turn(*view, Real(dx) * perUnit, -Real(dy) * perUnit));
  } else {
    steer(orbit(*view, Real(dx) * perUnit, -Real(dy) * perUnit));
  }
}

void Window::onScroll(double by, bool isZoom) {
  const auto [x, y] = cursor();
  isDirty_ = true;
  if (isZoom || request_.isPicture) {
    // What is under the cursor stays there.
    const float before = sheet_.zoom;
    isFitted_ = false;
    sheet_.zoom = std::clamp(before * float(std::pow(1.25, by)), 0.02f, 256.f);
    if (sheet_.zoom > 0.95f && sheet_.zoom < 1.05f) sheet_.zoom = 1;
    const float k = sheet_.zoom / before;
    sheet_.left = std::round(float(x) - k * (float(x) - sheet_.left));
    sheet_.top = std::round(float(y) - k * (float(y) - sheet_.top));
    return;
  }
  const auto block = camera();
  if (!block) return;
  if (const auto view = viewOf(*block, cameraSchema()))
    steer(dolly(*view, std::pow(kCloser, Real(by))));
}

void Window::click(double x, double y) {
  const auto at = pixelAt(x, y);
  if (!at || !preview_) return;
  if (isPicking_) {
    isPicking_ = false;
    return focusAt(x, y);
  }
  preview_->inspect(int(at->x), int(at->y), inspection_ ? inspection_->sample : 0);
}

/// Looks at what is there, and makes it sharp where there is a lens.
void Window::focusAt(double x, double y) {
  const auto at = pixelAt(x, y);
  const auto block = camera();
  if (!at || !snapshot_ || !block) return;
  const auto view = viewOf(*block, cameraSchema());
  if (!view) return;
  const Vec2 film = {at->x / Real(sheet_.width), at->y / Real(sheet_.height)};
  const auto ray = snapshot_->camera->sample(
      {film, {Real(0.5), Real(0.5)}, Real(sheet_.width) / Real(sheet_.height)});
  Surface hit;
  if (!ray ||
      !snapshot_->open->scene().view().intersect({ray->origin, ray->direction, 0, kInfinity}, hit))
    return say("there is nothing to focus at");
  keepForUndo();
  // The direction of view stays; what lies across it comes to the distance of the point.
  const Vec3 forward = normalize(view->lookAt - view->location);
  const Vec3 point = hit.position + snapshot_->open->scene().view().middle;
  const Real depth = dot(point - view->location, forward);
  if (!(depth > 0)) return;
  Block next = withView(*block, cameraSchema(),
                        {view->location, view->location + depth * forward, view->sky});
  if (cameraSchema().find("focus_distance")) {
    std::erase_if(next.settings.edit(), [](const Setting& s) { return s.name == "focal_point"; });
    next = withNumber(next, "focus_distance", double(depth));
  }
  useCamera(next);
  say(fmt::format("sharp at a distance of {:.4g}", double(depth)));
}

}  // namespace vestige::app
