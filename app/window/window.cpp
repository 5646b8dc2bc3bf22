// SPDX-License-Identifier: Apache-2.0
#include "app/window/window.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iostream>

#include "app/terminal.h"
#include "app/window/layers.h"

namespace vestige::app {
namespace {

constexpr double kWatchEvery = 0.15;     ///< seconds
constexpr double kFrameEvery = 1.0 / 8;  ///< while the renderer works: drawing takes a core as well
constexpr float kMargin = 8, kFontPixels = 13;
constexpr double kTap = 0.06, kLongestWalk = 0.2;  ///< seconds of walking

std::string lastError;  // GLFW tells errors to a function, before there is a window

Window& of(GLFWwindow* w) { return *static_cast<Window*>(glfwGetWindowUserPointer(w)); }

}  // namespace

Window::Window(const ViewRequest& request) : request_(request) {
  glfwSetErrorCallback([](int, const char* text) { lastError = text; });
  if (!glfwInit())
    throw Failure(kMachineFailed,
                  fmt::format("no window can be opened: {}. `vestige render` needs none",
                              lastError.empty() ? "there is no display" : lastError));
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  const std::string title =
      std::filesystem::path(request.input.file).filename().string() + " - vestige";
  window_ =
      glfwCreateWindow(request.windowWidth, request.windowHeight, title.c_str(), nullptr, nullptr);
  if (!window_) {
    glfwTerminate();
    throw Failure(kMachineFailed,
                  fmt::format("no window with OpenGL 3.3 can be opened: {}", lastError));
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  if (const std::string missing = gl::load(); !missing.empty())
    throw Failure(kMachineFailed, "the OpenGL driver lacks " + missing);
  installCallbacks();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::StyleColorsDark();
  setScale();
  ImGui_ImplGlfw_InitForOpenGL(window_, true);  // after ours: it calls them on
  ImGui_ImplOpenGL3_Init("#version 150");
  screen_ = std::make_unique<Screen>();
  std::string error;
  displays_ = displayViews(error);
  look_.display = request.display;
  if (!screen_->setDisplay(look_.display, error)) throw Failure(kCommandLineWrong, error);
  if (request.isPicture) {
    openPicture(request.input.file);
    watch_.watch({request.input.file});
  } else {
    watch_.watch({request.input.file});
    wish_.build = request.build, wish_.samples = request.render.samples;
    wish_.width = request.input.width, wish_.height = request.input.height;
    preview_ = std::make_unique<Preview>(request.input, request.render, wish_, glfwPostEmptyEvent);
  }
  if (!request.reference.empty()) openReference(request.reference);
}

/// Words and panels as large as on a display of ordinary density, and as sharp as this one can.
void Window::setScale() {
  float fineness = 1;
  int wide = 1, pixels = 1;
  glfwGetWindowContentScale(window_, &fineness, nullptr);
  glfwGetWindowSize(window_, &wide, nullptr);
  glfwGetFramebufferSize(window_, &pixels, nullptr);
  density_ = double(std::max(1, pixels)) / std::max(1, wide);
  scale_ = fineness / float(density_);
  ImGui::GetStyle().ScaleAllSizes(scale_);
  ImFontConfig font;
  font.SizePixels = std::round(kFontPixels * fineness);
  // The font is made of squares: sharp where they are whole pixels, else smoothed.
  font.PixelSnapH = true;
  font.OversampleH = std::fmod(font.SizePixels, kFontPixels) == 0 ? 1 : 3;
  ImGui::GetIO().Fonts->AddFontDefault(&font);
  ImGui::GetIO().FontGlobalScale = scale_ / fineness;
}

Window::~Window() {
  preview_.reset();
  screen_.reset();
  if (texture_) gl::DeleteTextures(1, &texture_);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::installCallbacks() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int mods) {
    of(w).isDirty_ = true;
    if (action == GLFW_RELEASE || ImGui::GetIO().WantCaptureKeyboard) return;
    of(w).onKey(key, mods);
    // A short tap, too, which may be over before walkByKeys() looks.
    if (action == GLFW_PRESS && mods == 0) of(w).walk({key}, kTap);
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
    of(w).isDirty_ = true;
    if (action == GLFW_RELEASE || !ImGui::GetIO().WantCaptureMouse)
      of(w).onButton(button, action == GLFW_PRESS, mods);
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
    of(w).isDirty_ = true;
    of(w).onMove(of(w).density_ * x, of(w).density_ * y);
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double by) {
    of(w).isDirty_ = true;
    const bool isControl = glfwGetKey(w, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
                           glfwGetKey(w, GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
    if (!ImGui::GetIO().WantCaptureMouse) of(w).onScroll(by, isControl);
  });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { of(w).isDirty_ = true; });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { of(w).isDirty_ = true; });
  glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned) { of(w).isDirty_ = true; });
}

void Window::run() {
  int settle = 3;  // ImGui needs a few frames after an event: hovering, layout
  while (!glfwWindowShouldClose(window_)) {
    glfwWaitEventsTimeout(settle > 0 ? 0.01 : kWatchEvery);
    update();
    if (isDirty_) settle = 3;
    if (!needsFrame() && settle <= 0) continue;
    --settle;
    isDirty_ = false;
    draw();
  }
}

/// Frames for what the user does come at once, for the renderer's progress a few times a second.
bool Window::needsFrame() {
  if (isDirty_) return true;
  const auto fresh = preview_ ? preview_->snapshot() : nullptr;
  const bool isNew = fresh != snapshot_;
  if (preview_ && preview_->inspection() != inspection_) return true;
  // The first picture of something else is waited for.
  if (isNew && (!snapshot_ || !fresh->wish.isSamePicture(snapshot_->wish))) return true;
  const bool isSoon = isNew || (preview_ && preview_->hovered() != hovered_);
  return preview_ && glfwGetTime() - lastFrame_ > (isSoon ? kFrameEvery : 0.5);
}

void Window::update() {
  const double now = glfwGetTime();
  walkByKeys(std::min(now - lastWalk_, kLongestWalk));
  lastWalk_ = now;
  if (now - lastWatch_ < kWatchEvery) return;
  lastWatch_ = now;
  if (preview_)
    if (const std::set<std::string> files = preview_->files(); !files.empty())
      watch_.watch(files, preview_->readAt());
  if (!watch_.hasChanged()) return;
  readAgain();
}

void Window::readAgain() {
  isDirty_ = true;
  if (!preview_) return openPicture(request_.input.file);
  wish_.isPaused = false;  // who saves wants to see
  hidesWarnings_ = false;
  restart(wish_.reload);
}

/// A camera in the hand stays there when the text is saved, unless it is the camera that changed.
void Window::takeScene() {
  const auto fresh = preview_->open();
  if (!fresh || fresh == open_) return;
  const auto textOf = [](const OpenScene& o) {
    return cameraText(placed(o.camera, o.cameraSchema));
  };
  const bool isOther = open_ && textOf(*open_) != textOf(*fresh);
  open_ = fresh;
  isDirty_ = true;
  if (!isOther || !wish_.camera) return;
  wish_.camera.reset();
  restart(wish_.view);
  say("the text's camera changed: back to it");
}

void Window::takeSnapshot() {
  if (!preview_) return;
  takeScene();
  if (const auto fresh = preview_->inspection(); fresh != inspection_) {
    inspection_ = fresh, isTextureStale_ = true;
    // The first with a texture: that is what footprints are for.
    vertex_ = 0;
    const auto& vertices = inspection_ ? inspection_->path.vertices : std::vector<PathVertex>{};
    for (std::size_t k = vertices.size(); k-- > 0;)
      if (vertices[k].surface.object >= 0 &&
          inspection_->open->scene().view().usesFootprint(vertices[k].surface))
        vertex_ = int(k);
  }
  if (const std::string news = preview_->news(); !news.empty()) say(news);
  if (const auto fresh = preview_->hovered(); fresh != hovered_) hovered_ = fresh, tellOfNotes();
  const auto fresh = preview_->snapshot();
  if (!fresh || fresh == snapshot_) return;
  snapshot_ = fresh;
  const bool isAov = !layer_.empty() && layer_ != kElementEdges && fresh->means.channels.size() > 3;
  shown_ = layer_ == kElementEdges ? withElementEdges(fresh->means) : layerOf(fresh->means, isAov);
  look_.isData = isAov;
  screen_->setPicture(shown_.rgb.data(), shown_.width, shown_.height);
  sheet_.width = fresh->filmWidth, sheet_.height = fresh->filmHeight;
  sheet_.part = fresh->part;
}

/// The whole picture beside the panels.
void Window::fit() {
  int w = 0, h = 0;
  glfwGetFramebufferSize(window_, &w, &h);
  const auto shown = float(hidesPanels_ ? 0 : density_);
  const float panel = shown * panelWidth(), bar = shown * statusHeight();
  const float margin = kMargin * float(fineness());
  const float wide = std::max(16.f, float(w) - panel - 2 * margin),
              high = std::max(16.f, float(h) - bar - 2 * margin);
  if (sheet_.width == 0) return;
  sheet_.zoom = std::min(wide / float(sheet_.width), high / float(sheet_.height));
  // Whole pixels where it is a matter of a few of them: one picture pixel, one of the window.
  if (sheet_.zoom >= 1 && sheet_.zoom < 2) sheet_.zoom = 1;
  if (sheet_.zoom > 2) sheet_.zoom = std::floor(sheet_.zoom);
  sheet_.left = std::round(margin + (wide - sheet_.zoom * float(sheet_.width)) / 2);
  sheet_.top = std::round(margin + (high - sheet_.zoom * float(sheet_.height)) / 2);
}

void Window::draw() {
  int w = 0, h = 0;
  int wide = 0;
  glfwGetFramebufferSize(window_, &w, &h);
  glfwGetWindowSize(window_, &wide, nullptr);
  if (w == 0 || h == 0 || wide == 0) return;  // minimised
  density_ = double(w) / wide;
  const std::shared_ptr<const Snapshot> before = snapshot_;
  takeSnapshot();
  if (isFitted_) fit();
  screen_->draw(look_, sheet_, w, h);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  drawOverlay();
  if (!hidesPanels_) drawPanels();
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (wantsShot_) saveScreenshot();
  glfwSwapBuffers(window_);
  lastFrame_ = glfwGetTime();
  if (snapshot_ && snapshot_ != before) tellOfPicture(before.get());
  if (preview_ && request_.tells) {
    const Status s = preview_->status();
    tell(s.isWrong ? "wrong" : s.phase);
  }
}

void Window::tellOfPicture(const Snapshot* before) {
  const bool isAsked = asked_ >= 0 && snapshot_->wish.isSamePicture(wish_);
  if (isAsked) waits_.push_back(lastFrame_ - asked_), asked_ = -1;
  if (!request_.tells) return;
  if (!before || !snapshot_->wish.isSamePicture(before->wish))
    std::cout << fmt::format("picture {} {:.0f} ms\n", snapshot_->integrator,
                             isAsked ? 1000 * waits_.back() : 0.0)
              << std::flush;
  std::cout << fmt::format("samples {} scale {}\n", snapshot_->samples, snapshot_->scale)
            << std::flush;
}

void Window::tellOfNotes() {
  if (!request_.tells || !hovered_ || hovered_->path.notes.empty()) return;
  const std::size_t vertex = hovered_->path.notes.front().vertex;
  std::cout << fmt::format("notes {}\n", notesText(hovered_->path, vertex)) << std::flush;
}

void Window::tellOfWaits() {
  if (waits_.empty() || !request_.tells) return;
  std::sort(waits_.begin(), waits_.end());
  std::cout << fmt::format(
      "waited {} times for another picture: median {:.0f} ms, worst {:.0f} ms\n", waits_.size(),
      1000 * waits_[waits_.size() / 2], 1000 * waits_.back());
}

void Window::tell(const std::string& event) {
  if (!request_.tells || event == told_) return;
  told_ = event;
  std::cout << event << std::endl;
}

void Window::saveScreenshot() {
  wantsShot_ = false;
  int w = 0, h = 0;
  glfwGetFramebufferSize(window_, &w, &h);
  const std::string file =
      std::filesystem::path(request_.input.file).stem().string() + "-window.png";
  std::string error;
  WriteOptions raw;
  raw.display.view = "Raw";
  say(writeImage(file, frame(w, h), raw, error) ? "wrote " + file : error);
}

void Window::say(const std::string& sentence) {
  told_.clear();  // the same sentence may be said twice
  tell(sentence);
  message_ = sentence;
  messageUntil_ = glfwGetTime() + 6;
  isDirty_ = true;
}

std::optional<Block> Window::camera() const {
  if (wish_.camera) return wish_.camera;
  if (open_) return open_->camera;
  return std::nullopt;
}

std::optional<Vec2> Window::pixelAt(double x, double y) const {
  const Vec2 p = {Real((x - sheet_.left) / sheet_.zoom), Real((y - sheet_.top) / sheet_.zoom)};
  if (p.x < 0 || p.y < 0 || p.x >= Real(sheet_.width) || p.y >= Real(sheet_.height))
    return std::nullopt;
  return p;
}

Vec2 Window::onWindow(Vec2 film) const {
  return Real(1 / density_) * Vec2{Real(sheet_.left) + Real(sheet_.zoom) * film.x,
                                   Real(sheet_.top) + Real(sheet_.zoom) * film.y};
}

std::pair<double, double> Window::cursor() const {
  double x = 0, y = 0;
  glfwGetCursorPos(window_, &x, &y);
  return {density_ * x, density_ * y};
}

int runWindow(const ViewRequest& request) {
  Window window(request);
  window.run();
  window.tellOfWaits();
  return kFine;
}

}  // namespace vestige::app
