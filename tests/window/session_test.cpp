// SPDX-License-Identifier: Apache-2.0
// The window itself, on a display without a screen (Xvfb), with hands from xdotool. VESTIGE_SHOTS
// names a folder that keeps the screenshots.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <thread>

#include "app/run.h"
#include "engine/picture/image.h"
#include "support/catch.h"

using namespace vestige;

namespace {

constexpr double kPatience = 60;
constexpr int kWide = 1000, kHigh = 700;  ///< of the window

bool has(const char* program) {
  return std::system(("command -v " + std::string(program) + " > /dev/null 2>&1").c_str()) == 0;
}

bool canRun() {
  const std::string view = std::string(VESTIGE_BINARY) + "-view";
  if (has("Xvfb") && has("xdotool") && access(view.c_str(), X_OK) == 0) return true;
  WARN("not run: it needs vestige-view, Xvfb and xdotool, which ./test installs");
  return false;
}

void rest(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// A child process that ends with its object.
class Child {
 public:
  Child(const std::vector<std::string>& words, const std::string& log, const std::string& folder) {
    std::fflush(stdout);  // or the child says it again
    pid_ = fork();
    if (pid_ != 0) return;
    std::vector<char*> arguments;
    for (const std::string& w : words) arguments.push_back(const_cast<char*>(w.c_str()));
    arguments.push_back(nullptr);
    if (!std::freopen(log.c_str(), "w", stdout) || chdir(folder.c_str()) != 0) _exit(126);
    dup2(1, 2);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  ~Child() {
    if (!isAlive()) return;
    kill(pid_, SIGTERM);  // Xvfb takes its lock away with it
    for (int i = 0; i < 100 && isAlive(); ++i) rest(0.02);
    if (isAlive()) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  bool isAlive() {
    if (!ended_ && waitpid(pid_, &status_, WNOHANG) == pid_) ended_ = true;
    return !ended_;
  }
  int exitCode() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_); }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = 0;
  int status_ = 0;
  bool ended_ = false;
};

std::string contents(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string output(const std::string& command) {
  std::string text;
  if (FILE* pipe = popen(command.c_str(), "r")) {
    char piece[256];
    while (std::fgets(piece, sizeof piece, pipe)) text += piece;
    pclose(pipe);
  }
  return text;
}

class Session {
 public:
  /// Opens a scene of this text, or the picture `opened`, on a display with these X resources.
  Session(const std::string& text, const std::vector<std::string>& options = {},
          const std::string& opened = "", const std::string& resources = "")
      : file_(opened.empty() ? folder_.write("a.scene", text) : opened),
        stem_(std::filesystem::path(file_).stem().string()),
        log_(folder_ / "log") {
    server_ = std::make_unique<Child>(
        std::vector<std::string>{"Xvfb", "-displayfd", "1", "-noreset", "-screen", "0",
                                 "2560x1600x24", "+extension", "GLX"},
        folder_ / "xvfb", folder_.path().string());
    // It writes the number of the display, and a line end, once it is ready.
    std::string number;
    for (int i = 0; i < 200 && server_->isAlive() && number.empty(); ++i) {
      rest(0.05);
      std::istringstream said(contents(folder_ / "xvfb"));
      for (std::string line; std::getline(said, line) && !said.eof();)
        if (line.find_first_not_of("0123456789") == line.npos) number = line;
    }
    INFO(contents(folder_ / "xvfb"));
    REQUIRE(number != "");
    setenv("DISPLAY", (":" + number).c_str(), 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    if (!resources.empty())
      REQUIRE(std::system(
                  ("xprop -root -f RESOURCE_MANAGER 8s -set RESOURCE_MANAGER '" + resources + "\n'")
                      .c_str()) == 0);
    std::vector<std::string> words = {std::string(VESTIGE_BINARY),
                                      "view",
                                      file_,
                                      "--events",
                                      "--window-width",
                                      std::to_string(kWide),
                                      "--window-height",
                                      std::to_string(kHigh)};
    words.insert(words.end(), options.begin(), options.end());
    view_ = std::make_unique<Child>(words, log_, folder_.path().string());
    for (int i = 0; i < 200 && id_.empty(); ++i) {
      rest(0.05);
      id_ = output("xdotool search --name 'vestige$' 2>/dev/null");
      id_.erase(std::remove(id_.begin(), id_.end(), '\n'), id_.end());
    }
    INFO(contents(log_));
    REQUIRE(id_ != "");
  }

  void hand(const std::string& actions) {
    INFO("xdotool " << actions);
    CHECK(std::system(("xdotool " + actions).c_str()) == 0);
  }
  void key(const std::string& name) { hand("key --window " + id_ + ' ' + name); }
  void move(double x, double y) {
    hand("mousemove --window " + id_ + ' ' + std::to_string(int(x)) + ' ' + std::to_string(int(y)));
    rest(0.1);  // a frame, so that the window knows where the mouse is
  }
  void click(double x, double y) { move(x, y), hand("click 1"), rest(0.1); }
  void drag(double x0, double y0, double x1, double y1) {
    move(x0, y0), hand("mousedown 1");
    for (int i = 1; i <= 6; ++i) move(x0 + (x1 - x0) * i / 6, y0 + (y1 - y0) * i / 6);
    hand("mouseup 1"), rest(0.1);
  }
  void write(const std::string& text) { folder_.write("a.scene", text); }

  /// Waits until what happened since the last call holds these words.
  void comes(const std::string& words) {
    INFO("waiting for '" << words << "' in\n" << contents(log_));
    for (double waited = 0; waited < kPatience; waited += 0.02) {
      const std::string log = contents(log_);
      if (const std::size_t at = log.find(words, seen_); at != log.npos) {
        seen_ = at + words.size();
        return;
      }
      REQUIRE(view_->isAlive());
      rest(0.02);
    }
    FAIL("it never came");
  }
  void forget() { seen_ = contents(log_).size(); }

  /// What the window shows, kept under `name`.
  Image shot(const std::string& name) {
    rest(0.3);  // what was asked for is drawn
    forget();
    key("F12");
    comes("wrote " + stem_ + "-window.png");
    std::string error;
    const std::string file = folder_ / (stem_ + "-window.png");
    const Image image = readImage(file, error);
    REQUIRE(image.width > 0);
    if (const char* kept = std::getenv("VESTIGE_SHOTS"))
      std::filesystem::copy_file(file, std::filesystem::path(kept) / (name + ".png"),
                                 std::filesystem::copy_options::overwrite_existing);
    return image;
  }
  Image saved() {
    forget();
    key("p");
    comes("wrote " + stem_ + "-view.png");
    std::string error;
    return readImage(folder_ / (stem_ + "-view.png"), error);
  }
  int close() {
    key("ctrl+q");
    for (int i = 0; i < 500 && view_->isAlive(); ++i) rest(0.02);
    return view_->isAlive() ? kHung : view_->exitCode();
  }
  bool isAlive() { return view_->isAlive(); }
  pid_t pid() const { return view_->pid(); }
  std::string log() const { return contents(log_); }
  const Folder& folder() const { return folder_; }
  const std::string& id() const { return id_; }

 private:
  Folder folder_;
  std::string file_, stem_, log_, id_;
  std::size_t seen_ = 0;
  std::unique_ptr<Child> server_, view_;
};

std::string scene(const std::string& colour, const std::string& more = "") {
  return "camera pinhole { location <0, 1.2, -4> look_at <0, 0.8, 0> angle 50 }\n"
         "film { resolution <320, 240> }\n"
         "integrator path { samples 16 depth 6 }\n"
         "light environment { radiance rgb 0.7 }\n"
         "light area { <-1, 3, -2>, <2, 0, 0>, <0, 0, 2> radiance rgb 6 }\n"
         "plane { y, 0 brdf lambert { diffuse pigment checker { rgb 0.2, rgb 0.8 scale 0.4 } } }\n"
         "sphere { <-0.8, 0.7, 0.5>, 0.7 brdf lambert { diffuse rgb " +
         colour +
         " } }\n"
         "sphere { <0.9, 0.7, -0.2>, 0.7 brdf glass { } }\n" +
         more;
}

/// Where the sheet lies with hidden panels; as Window::fit() has it.
struct Place {
  double left, top, zoom;
};
Place placeOf(int width, int height, double panel = 0, double bar = 0) {
  const double wide = kWide - panel - 16, high = kHigh - bar - 16;
  double zoom = std::min(wide / width, high / height);
  if (zoom >= 1 && zoom < 2) zoom = 1;
  if (zoom > 2) zoom = std::floor(zoom);
  return {std::round(8 + (wide - zoom * width) / 2), std::round(8 + (high - zoom * height) / 2),
          zoom};
}
constexpr double kPanel = 350, kBar = 26;

const float* at(const Image& image, const Place& p, double x, double y) {
  return image.at(int(p.left + p.zoom * x), int(p.top + p.zoom * y));
}

double difference(const Image& a, const Image& b, int x0, int y0, int x1, int y1) {
  double sum = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      for (int c = 0; c < 3; ++c) sum += std::abs(double(a.at(x, y)[c]) - double(b.at(x, y)[c]));
  return sum / double((x1 - x0) * (y1 - y0) * 3);
}

}  // namespace

TEST_CASE("a session: look, turn, change the text, break it, mend it, inspect, save", "[window]") {
  if (!canRun()) return;
  Session s(scene("<0.8, 0.1, 0.1>"));
  s.comes("picture path");
  s.comes("finished");
  const Place p = placeOf(320, 240, kPanel, kBar);
  const Image first = s.shot("1-first");
  const float* red = at(first, p, 100, 110);
  CHECK(red[0] > 2 * red[2]);

  s.drag(p.left + 200, p.top + 60, p.left + 320, p.top + 60);
  s.comes("finished");
  const Image turned = s.shot("2-orbit");
  CHECK(difference(first, turned, 20, 20, 600, 600) > 0.02);
  s.key("Home");
  s.comes("finished");

  s.write(scene("<0.1, 0.1, 0.8>"));
  s.comes("picture path");
  s.comes("finished");
  const Image changed = s.shot("3-changed");
  const float* blue = at(changed, p, 100, 110);
  CHECK(blue[2] > 2 * blue[0]);

  s.write(scene("<0.1, 0.1, 0.8>", "sphre { }\n"));
  s.comes("wrong");
  const Image broken = s.shot("4-broken");
  const float* still = at(broken, p, 100, 200);  // under the words
  CHECK(still[2] == Approx(at(changed, p, 100, 200)[2]).margin(0.01));
  CHECK(difference(changed, broken, 20, 20, 400, 100) > 0.02);  // the words
  s.write(scene("<0.1, 0.8, 0.1>"));
  s.comes("picture path");
  s.comes("finished");
  const Image mended = s.shot("5-mended");
  CHECK(at(mended, p, 100, 110)[1] > 2 * at(mended, p, 100, 110)[0]);

  s.click(p.left + p.zoom * 215, p.top + p.zoom * 118);  // glass
  const Image inspected = s.shot("6-inspected");
  CHECK(difference(mended, inspected, 20, 20, 600, 600) > 1e-4);     // the path over the picture
  CHECK(difference(mended, inspected, 660, 420, 990, 660) > 0.005);  // its numbers

  s.key("Escape");
  CHECK(difference(mended, s.shot("10-escaped"), 660, 420, 990, 640) < 0.002);

  const Image picture = s.saved();
  CHECK(picture.width == 320);
  CHECK(s.close() == 0);
  CHECK_THAT(s.log(), containsText("times for another picture: median"));
}

TEST_CASE("what the window shows is what the colour library says", "[window]") {
  if (!canRun()) return;
  for (const char* view : {"Standard", "ACES 1.0 SDR"}) {
    Session s(scene("<0.8, 0.1, 0.1>"), {"--view", view, "--exposure", "0.7"});
    s.comes("finished");
    s.key("Tab");
    const Image seen = s.shot(std::string("view-") + view[0]), saved = s.saved();
    REQUIRE(saved.width == 320);
    const Place p = placeOf(320, 240);
    REQUIRE(p.zoom == 2);
    double worst = 0;
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x)
        for (int c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(double(at(seen, p, x + 0.5, y + 0.5)[c]) -
                                           double(saved.at(x, y)[c])));
    CHECK(worst * 255 < 1.5);  // one code value
    CHECK(s.close() == 0);
  }
}

TEST_CASE("a session: from paths to particles, whose elements refine", "[window]") {
  if (!canRun()) return;
  Session s(
      "camera pinhole { location <0, 1.5, -4> look_at <0, 0.5, 0> }\n"
      "film { resolution <240, 180> }\n"
      "light area { <-1, 3, -1>, <2, 0, 0>, <0, 0, 2> radiance rgb 5 }\n"
      "quad { <-3, 0, -3>, <6, 0, 0>, <0, 0, 6> }\n"
      "sphere { <0, 0.6, 0>, 0.6 }\n"
      "integrator particle { particles 2000000 samples 4 }\n",
      {"--integrator", "path"});
  s.comes("picture path");
  s.comes("finished");
  const Image paths = s.shot("7-paths");
  const Place p = placeOf(240, 180, kPanel, kBar);
  s.move(p.left + p.zoom * 150, p.top + p.zoom * 130);  // on the floor, in the ball's shadow
  s.forget();
  for (int i = 0; i < 20 && s.log().find("integrator particle") == std::string::npos; ++i)
    s.key("n"), rest(0.2);
  s.comes("picture particle");
  s.comes("finished");
  const Image particles = s.shot("7-particles");
  CHECK(difference(paths, particles, 20, 20, 600, 600) > 1e-4);
  s.move(p.left + p.zoom * 150, p.top + p.zoom * 131);
  s.comes("notes element.level");
  std::vector<int> levels;
  std::istringstream lines(s.log());
  for (std::string line; std::getline(lines, line);) {
    int level = 0;
    double flux = 0, area = 0;
    if (std::sscanf(line.c_str(),
                    "notes element.level %d, element.id %*d, element.area %lf scene units^2, "
                    "element.flux <%lf, %*f, %*f> W",
                    &level, &area, &flux) != 3)
      continue;
    levels.push_back(level);
    CHECK(flux > 0);
    CHECK(area == Approx(36 * std::pow(0.25, level)).epsilon(1e-3));
  }
  REQUIRE(levels.size() > 2);
  CHECK(levels.back() > levels.front());
  CHECK(s.saved().width == 240);
  CHECK(s.close() == 0);
}

TEST_CASE("where pixels are half as wide all is of twice as many", "[window]") {
  if (!canRun()) return;
  if (!has("xprop")) {
    WARN("not run: it needs xprop, of x11-utils");
    return;
  }
  Session s(scene("<0.8, 0.1, 0.1>"), {}, "", "Xft.dpi: 192");
  s.comes("finished");
  const Image before = s.shot("11-dense");
  CHECK(before.width == 2 * kWide);
  CHECK(before.height == 2 * kHigh);
  const double wide = 2 * (kWide - kPanel - 16), high = 2 * (kHigh - kBar - 16);
  const Place p = {std::round(16 + (wide - 3 * 320) / 2), std::round(16 + (high - 3 * 240) / 2), 3};
  CHECK(at(before, p, 100, 110)[0] > 2 * at(before, p, 100, 110)[2]);
  // A click hits the pixel below it: there the path begins, with a yellow dot.
  s.click(p.left + p.zoom * 215.5, p.top + p.zoom * 118.5);
  const Image inspected = s.shot("12-dense-inspected");
  const float* dot = at(inspected, p, 215.5, 118.5);
  CHECK(dot[0] > 0.8f);
  CHECK(dot[1] > 0.6f);
  CHECK(dot[2] < 0.5f);
  CHECK(s.close() == 0);
}

TEST_CASE("without a display there is one clear sentence", "[window]") {
  if (!canRun()) return;
  const Folder folder;
  const std::string file = folder.write("a.scene", scene("1"));
  const Run r =
      runVestige({"view", file}, {.variables = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}}});
  CHECK(r.exit == 3);
  CHECK_THAT(r.err, containsText("no window can be opened") && containsText("vestige render"));
  CHECK(runVestige({"view", folder / "none.scene"}).exit == 2);
  CHECK(runVestige({"view", "--help"}).exit == 0);
  CHECK(runVestige({"view", file, "--integrator", "none"}).exit == 2);
}

TEST_CASE("pictures from files are shown, and followed", "[window]") {
  if (!canRun()) return;
  const Folder folder;
  Image image;
  image.width = 64, image.height = 48, image.channels = {"R", "G", "B"};
  image.pixels.assign(64 * 48 * 3, 0.05f);
  std::string error;
  REQUIRE(writeImage(folder / "p.exr", image, {}, error));
  Session s("", {}, folder / "p.exr");
  const Place p = placeOf(64, 48, kPanel, kBar);
  CHECK(at(s.shot("8-picture"), p, 32, 24)[1] == Approx(63 / 255.0).margin(0.01));  // sRGB of 0.05
  image.pixels.assign(64 * 48 * 3, 0.5f);
  REQUIRE(writeImage(folder / "p.exr", image, {}, error));
  rest(1);
  CHECK(at(s.shot("9-picture"), p, 32, 24)[1] == Approx(188 / 255.0).margin(0.01));
  CHECK(s.close() == 0);
}

TEST_CASE("a picture wider than a texture may be is shown reduced, its numbers are its own",
          "[window]") {
  if (!canRun()) return;
  const Folder folder;
  Image image;  // Mesa's textures have 16384 pixels a side at most
  image.width = 16600, image.height = 500, image.channels = {"R", "G", "B"};
  image.pixels.assign(std::size_t(image.width) * image.height * 3, 0.05f);
  for (std::size_t y = 0; y < 500; ++y)
    std::fill_n(&image.pixels[(y * 16600 + 8300) * 3], 8300 * 3, 0.5f);
  std::string error;
  REQUIRE(writeImage(folder / "p.exr", image, {}, error));
  Session s("", {}, folder / "p.exr");
  const Place p = placeOf(image.width, image.height, kPanel, kBar);
  const Image shot = s.shot("13-wide");
  CHECK(at(shot, p, 5000, 250)[1] == Approx(63 / 255.0).margin(0.01));  // sRGB of 0.05
  CHECK(at(shot, p, 12000, 250)[1] == Approx(188 / 255.0).margin(0.01));
  s.forget();
  s.key("p");  // through the view, at its full size
  s.comes("wrote p-view.png");
  CHECK(readImage(s.folder() / "p-view.png", error).width == image.width);
  CHECK(s.close() == 0);
}

TEST_CASE("five hundred random inputs", "[window][slow]") {
  if (!canRun()) return;
  Session s(scene("<0.8, 0.1, 0.1>"));
  s.comes("picture path");
  std::mt19937 random(3);
  const std::vector<std::string> keys = {
      "w", "a", "s",   "d",     "e",    "x",      "f",     "r",      "c",  "z",   "b", "v",
      "h", "p", "Tab", "space", "Home", "Escape", "comma", "period", "F5", "F12", "0", "1"};
  for (int i = 0; i < 500; ++i) {
    const int x = int(random() % kWide), y = int(random() % kHigh);
    switch (random() % 5) {
      case 0:
        s.hand("mousemove --window " + s.id() + ' ' + std::to_string(x) + ' ' + std::to_string(y) +
               " click " + std::to_string(1 + random() % 5));
        break;
      case 1:
        s.hand("mousedown " + std::to_string(1 + random() % 3) + " mousemove --window " + s.id() +
               ' ' + std::to_string(x) + ' ' + std::to_string(y) +
               " mouseup 1 mouseup 2 mouseup 3");
        break;
      case 2:
        if (random() % 4 == 0) s.write(scene("<0.1, 0." + std::to_string(i) + ", 0.8>"));
        if (random() % 8 == 0) s.write("sphere {");
        break;
      case 3:
        if (random() % 10 == 0)
          s.hand("windowsize " + s.id() + ' ' + std::to_string(200 + random() % 900) + ' ' +
                 std::to_string(100 + random() % 600));
        break;
      default:
        s.key(keys[random() % keys.size()]);
    }
    REQUIRE(s.isAlive());
  }
  s.key("Escape");
  CHECK(s.close() == 0);
}

TEST_CASE("five minutes of reloads and turns keep the memory", "[window][slow]") {
  if (!canRun()) return;
  Session s(scene("<0.8, 0.1, 0.1>"));
  s.comes("picture path");
  const auto resident = [&] {
    std::istringstream in(contents("/proc/" + std::to_string(s.pid()) + "/statm"));
    double all = 0, pages = 0;
    in >> all >> pages;
    return pages * double(sysconf(_SC_PAGESIZE)) / 1e6;
  };
  const char* minutes = std::getenv("VESTIGE_SOAK_MINUTES");
  const double seconds = 60 * (minutes ? std::atof(minutes) : 5);
  double early = 0, late = 0;
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  for (int i = 0; elapsed() < seconds; ++i) {
    s.write(scene("<0.1, 0." + std::to_string(i % 10) + ", 0.8>"));
    s.drag(100 + i % 7 * 30, 100, 300, 150 + i % 5 * 20);
    if (i % 10 == 0) s.click(300, 200);
    // The first third warms up: allocators keep what they once had.
    (elapsed() < seconds / 3 ? early : late) =
        std::max(elapsed() < seconds / 3 ? early : late, resident());
    REQUIRE(s.isAlive());
  }
  WARN("resident: " << early << " MB at most in the first third, " << late << " MB after it");
  CHECK(late < 1.05 * early);
  CHECK(s.close() == 0);
}
