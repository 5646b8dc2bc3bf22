// SPDX-License-Identifier: Apache-2.0
// The window: what the user sees and does. One thread; nothing here waits for the renderer.
#pragma once
#include <deque>
#include <memory>

#include "app/window/footprint_region.h"
#include "app/window/request.h"
#include "app/window/screen.h"
#include "app/window/steer.h"
#include "app/window/watch.h"

struct ImDrawList;

namespace vestige::app {

/// A picture in memory that may be compared with: RGB.
struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgb;
};

class Window {
 public:
  explicit Window(const ViewRequest& request);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  void run();
  /// Of --events: how long the user waited for pictures.
  void tellOfWaits();

 private:
  // window.cpp: the loop
  void setScale();
  void installCallbacks();
  void update();
  void readAgain();
  void takeSnapshot();
  void takeScene();
  void draw();
  bool needsFrame();
  void fit();
  void saveScreenshot();
  // input.cpp: keys and mouse
  void onKey(int key, int mods);
  void onButton(int button, bool isDown, int mods);
  void onMove(double x, double y);
  void onScroll(double by, bool isZoom);
  void walkByKeys(double seconds);
  void walk(const std::vector<int>& keys, double seconds);
  void click(double x, double y);
  void focusAt(double x, double y);
  void steer(const View& view);
  void keepForUndo();
  void undo();
  void useCamera(Block camera);
  void restart(int& counter);
  void takeNextIntegrator();
  // panels.cpp: ImGui
  void drawPanels();
  void drawPicturePanel();
  void drawLightPanel();
  void drawCameraPanel();
  void drawComparePanel();
  void drawPixelPanel();
  void drawNotes(int x, int y);
  // inspector.cpp: the clicked path
  void drawInspectorPanel();
  void drawVertex(std::size_t index, const std::vector<std::string>& names);
  void drawTexturePanel();
  // messages.cpp
  void drawComplaints();
  void drawStatus();
  void drawHelp();
  // overlay.cpp: what lies over the picture
  void drawOverlay();
  void drawPath(ImDrawList& list);
  // documents
  void openPicture(const std::string& file);
  void openReference(const std::string& file);
  void keepAsOther();
  void makeFlip();
  void savePicture(const std::string& file);
  void openInEditor(const lang::Place& place);
  void say(const std::string& sentence);
  /// Of --events.
  void tell(const std::string& event);
  void tellOfPicture(const Snapshot* before);
  void tellOfNotes();

  /// Of the side panel and the line at the bottom, in what ImGui counts in.
  float panelWidth() const { return 350 * scale_; }
  float statusHeight() const { return 26 * scale_; }
  /// Pixels of the frame where an ordinary display has one.
  double fineness() const { return density_ * double(scale_); }

  /// What the camera is now: in the hand, or in the text.
  std::optional<Block> camera() const;
  const Schema& cameraSchema() const { return open_->cameraSchema; }
  /// All of the mouse is in pixels of the frame; ImGui counts in those of the window.
  std::pair<double, double> cursor() const;
  std::optional<Vec2> pixelAt(double x, double y) const;  ///< of the film; nullopt: beside it
  Vec2 onWindow(Vec2 film) const;  ///< from pixels of the film to what ImGui counts in

  ViewRequest request_;
  GLFWwindow* window_ = nullptr;
  std::unique_ptr<Screen> screen_;
  std::unique_ptr<Preview> preview_;
  FileWatch watch_;
  Wish wish_;

  // What is shown
  std::shared_ptr<const OpenScene> open_;
  std::shared_ptr<const Snapshot> snapshot_;
  Image opened_;  ///< a picture from a file, in place of a scene
  Picture shown_;
  Picture other_;
  std::string otherName_;
  Look look_;
  Sheet sheet_;
  bool isFitted_ = true;
  std::string layer_;  ///< an AOV, or kElementEdges; "": the picture
  std::vector<DisplayViews> displays_;
  std::string message_;
  double messageUntil_ = 0;

  std::deque<std::optional<Block>> undo_;  ///< cameras, wish_.camera before each turn of the hand
  double lastUndo_ = -1;

  // The mouse
  int button_ = -1;
  bool isDragged_ = false, isPicking_ = false, isRegion_ = false, isWipe_ = false;
  double downX_ = 0, downY_ = 0, lastX_ = 0, lastY_ = 0;

  // The inspector
  std::shared_ptr<const Inspection> inspection_, hovered_;
  int hoverX_ = -1, hoverY_ = -1;            ///< what was asked about last
  std::weak_ptr<const Snapshot> hoverOver_;  ///< ... and in which picture
  Reckoning reckoning_;
  int boundChoice_ = 0;
  int vertex_ = 0;         ///< whose texture is shown
  float textureZoom_ = 6;  ///< side of the texture panel over the footprint's
  GLuint texture_ = 0;
  bool isTextureStale_ = true;

  bool isDirty_ = true, hidesPanels_ = false, showsHelp_ = false, hidesWarnings_ = false,
       wantsShot_ = false;
  double lastFrame_ = 0, lastWatch_ = 0, lastWalk_ = 0;
  // HiDPI: a window counts in pixels of its frame (X11) or in larger units (macOS, Wayland).
  double density_ = 1;         ///< pixels of the frame for one of the window's units
  float scale_ = 1;            ///< of words and panels, in the window's units
  double asked_ = -1;          ///< when the user last asked for another picture; -1: it is shown
  std::vector<double> waits_;  ///< seconds from there to its first frame
  std::string told_;
  char file_[512] = "", reference_[512] = "";
};

}  // namespace vestige::app
