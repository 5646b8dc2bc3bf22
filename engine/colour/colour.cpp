// SPDX-License-Identifier: Apache-2.0
#include "engine/colour/colour.h"

#include <fmt/format.h>
#include <OpenColorIO/OpenColorIO.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <sstream>
#include <vector>

namespace vestige {

namespace OCIO = OCIO_NAMESPACE;

namespace {

constexpr const char* kRenderingSpace = "Linear Rec.709";  // its name in config.ocio

/// OpenColorIO's messages have several lines; the first one contains the error.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

OCIO::ConstConfigRcPtr builtinConfig() {
  static const OCIO::ConstConfigRcPtr config = [] {
    std::istringstream text(kBuiltinColourConfig);
    return OCIO::Config::CreateFromStream(text);
  }();
  return config;
}

/// The config in use, read again only when OCIO names another one.
OCIO::ConstConfigRcPtr currentConfig(std::string& error) {
  static std::mutex mutex;
  static std::string loadedName;
  static OCIO::ConstConfigRcPtr loaded;
  const char* name = std::getenv("OCIO");
  if (!name || !*name) return builtinConfig();
  const std::lock_guard lock(mutex);
  if (loaded && loadedName == name) return loaded;
  try {
    loaded = OCIO::Config::CreateFromFile(name);
    loadedName = name;
    return loaded;
  } catch (const OCIO::Exception& e) {
    error = fmt::format(
        "the colour config '{}' that the environment variable OCIO names cannot be "
        "used: {}",
        name, firstLine(e.what()));
    return nullptr;
  }
}

/// Rendering space under one of the names that it goes by in published configs, or "".
std::string renderingSpaceIn(const OCIO::ConstConfigRcPtr& config) {
  for (const char* name :
       {kRenderingSpace, "Linear Rec.709 (sRGB)", "lin_rec709", "lin_rec709_srgb", "lin_srgb",
        "Utility - Linear - Rec.709", "Utility - Linear - sRGB", "Linear BT.709"})
    if (const auto space = config->getColorSpace(name)) return space->getName();
  return {};
}

class Steps final : public ColourTransform {
 public:
  void add(const OCIO::ConstProcessorRcPtr& processor) {
    if (processor->isNoOp()) return;
    processors_.push_back(processor);
    steps_.push_back(processor->getDefaultCPUProcessor());
  }
  void append(const Steps& more) {
    for (const auto& processor : more.processors_) add(processor);
  }
  void scaleFirst(double factor) { scale_ = float(factor); }

  bool isIdentity() const noexcept override { return steps_.empty() && scale_ == 1; }
  void apply(float* pixels, std::size_t count, int stride) const override {
    if (scale_ != 1)
      for (std::size_t i = 0; i < count; ++i)
        for (int c = 0; c < 3; ++c) pixels[i * stride + c] *= scale_;
    if (count == 0) return;
    OCIO::PackedImageDesc view(pixels, long(count), 1, 3, OCIO::BIT_DEPTH_F32, sizeof(float),
                               std::ptrdiff_t(stride * sizeof(float)),
                               std::ptrdiff_t(count * stride * sizeof(float)));
    for (const auto& step : steps_) step->apply(view);
  }

  /// GLSL of all steps but the exposure, one after the other; "" if one needs tables.
  std::string shader(const std::string& function) const {
    std::string text, calls;
    int count = 0;
    for (const auto& processor : processors_) {
      OCIO::GpuShaderDescRcPtr part = OCIO::GpuShaderDesc::CreateShaderDesc();
      const std::string name = fmt::format("step{}", count++);
      part->setLanguage(OCIO::GPU_LANGUAGE_GLSL_1_3);
      part->setFunctionName(name.c_str());
      part->setResourcePrefix((name + "_").c_str());
      processor->getDefaultGPUProcessor()->extractGpuShaderInfo(part);
      if (part->getNumTextures() > 0 || part->getNum3DTextures() > 0) return "";
      text += part->getShaderText();
      calls += fmt::format("  c = {}(c);\n", name);
    }
    return text + fmt::format("vec4 {}(vec4 c) {{\n{}  return c;\n}}\n", function, calls);
  }

 private:
  float scale_ = 1;
  std::vector<OCIO::ConstProcessorRcPtr> processors_;
  std::vector<OCIO::ConstCPUProcessorRcPtr> steps_;
};

/// A space of the config that rendering space can be turned into, and the step that does it. A
/// config without linear Rec. 709 is reached through the interchange role; one without that role is
/// taken to render in linear Rec. 709.
std::string entrySpace(const OCIO::ConstConfigRcPtr& config, Steps& steps, bool inwards) {
  std::string name = renderingSpaceIn(config);
  if (!name.empty()) return name;
  const char* linear = OCIO::ROLE_SCENE_LINEAR;
  try {
    steps.add(inwards ? OCIO::Config::GetProcessorFromConfigs(builtinConfig(), kRenderingSpace,
                                                              config, linear)
                      : OCIO::Config::GetProcessorFromConfigs(config, linear, builtinConfig(),
                                                              kRenderingSpace));
  } catch (const OCIO::Exception&) {
    return linear;
  }
  return linear;
}

std::string names(int count, const std::function<const char*(int)>& name) {
  std::string list;
  for (int i = 0; i < count; ++i) list += fmt::format("{}'{}'", i ? ", " : "", name(i));
  return list;
}

/// Display and view as the config spells them, defaults filled in; false with `error`.
bool chooseView(const OCIO::ConstConfigRcPtr& config, Display& wanted, std::string& error) {
  if (wanted.display.empty()) wanted.display = config->getDefaultDisplay();
  const char* display = wanted.display.c_str();
  const int views = config->getNumViews(display);
  if (views == 0) {
    error =
        fmt::format("the colour config has no display '{}'; it has {}", wanted.display,
                    names(config->getNumDisplays(), [&](int i) { return config->getDisplay(i); }));
    return false;
  }
  if (wanted.view.empty()) wanted.view = config->getDefaultView(display);
  for (int i = 0; i < views; ++i)
    if (wanted.view == config->getView(display, i)) return true;
  error =
      fmt::format("the colour config has no view '{}' for the display '{}'; it has {}", wanted.view,
                  wanted.display, names(views, [&](int i) { return config->getView(display, i); }));
  return false;
}

}  // namespace

double decodeSrgb(double code) noexcept {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}
double encodeSrgb(double linear) noexcept {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

std::shared_ptr<const ColourTransform> fromColourSpace(const std::string& space,
                                                       std::string& error) {
  const auto config = currentConfig(error);
  if (!config) return nullptr;
  if (!config->getColorSpace(space.c_str())) {
    error = fmt::format("the colour config has no colour space '{}'; it has {}", space,
                        names(config->getNumColorSpaces(),
                              [&](int i) { return config->getColorSpaceNameByIndex(i); }));
    return nullptr;
  }
  try {
    auto steps = std::make_shared<Steps>();
    // A space marked as data leaves numbers unchanged.
    if (config->getColorSpace(space.c_str())->isData()) return steps;
    Steps out;
    const std::string entry = entrySpace(config, out, false);
    steps->add(config->getProcessor(space.c_str(), entry.c_str()));
    steps->append(out);
    return steps;
  } catch (const OCIO::Exception& e) {
    error =
        fmt::format("the colour space '{}' cannot be converted: {}", space, firstLine(e.what()));
    return nullptr;
  }
}

namespace {

std::shared_ptr<const Steps> displaySteps(const Display& display, std::string& error) {
  const auto config = currentConfig(error);
  Display wanted = display;
  if (!config || !chooseView(config, wanted, error)) return nullptr;
  try {
    auto steps = std::make_shared<Steps>();
    steps->scaleFirst(std::exp2(display.exposure));
    const std::string entry = entrySpace(config, *steps, true);
    const auto transform = OCIO::DisplayViewTransform::Create();
    transform->setSrc(entry.c_str());
    transform->setDisplay(wanted.display.c_str());
    transform->setView(wanted.view.c_str());
    steps->add(config->getProcessor(transform));
    return steps;
  } catch (const OCIO::Exception& e) {
    error = fmt::format("the view '{}' cannot be made: {}", wanted.view, firstLine(e.what()));
    return nullptr;
  }
}

}  // namespace

std::shared_ptr<const ColourTransform> forDisplay(const Display& display, std::string& error) {
  return displaySteps(display, error);
}

bool applyDisplay(const Display& display, float* pixels, std::size_t count, int stride,
                  std::string& error) {
  const auto steps = displaySteps(display, error);
  if (steps) steps->apply(pixels, count, stride);
  return steps != nullptr;
}

std::string displayShader(const Display& display, std::string& error) {
  const auto steps = displaySteps(display, error);
  if (!steps) return "";
  std::string text;
  try {
    text = steps->shader("displayed");
    if (text.empty()) error = fmt::format("the view '{}' needs tables", display.view);
  } catch (const OCIO::Exception& e) {
    error = fmt::format("the view '{}' has no shader: {}", display.view, firstLine(e.what()));
  }
  return text;
}

std::vector<DisplayViews> displayViews(std::string& error) {
  std::vector<DisplayViews> all;
  const auto config = currentConfig(error);
  if (!config) return all;
  const std::string first = config->getDefaultDisplay();
  for (int d = 0; d < config->getNumDisplays(); ++d) {
    DisplayViews display{config->getDisplay(d), {}};
    const std::string usual = config->getDefaultView(display.display.c_str());
    for (int v = 0; v < config->getNumViews(display.display.c_str()); ++v) {
      const std::string view = config->getView(display.display.c_str(), v);
      display.views.insert(view == usual ? display.views.begin() : display.views.end(), view);
    }
    all.insert(display.display == first ? all.begin() : all.end(), display);
  }
  return all;
}

std::string colourLibraryVersion() { return OCIO::GetVersion(); }

}  // namespace vestige
