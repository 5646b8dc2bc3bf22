// SPDX-License-Identifier: Apache-2.0
#include "material.h"

#include <filesystem>

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <vestige/schema.h>

namespace vestige::mesh {
namespace {

/// Reads one material and writes it in the words of the scene language.
class Converter {
 public:
  Converter(const aiScene& scene, const aiMaterial& from, const std::string& meshPath,
            const Witness& witness, std::vector<std::string>& warnings)
      : scene_(scene),
        from_(from),
        folder_(std::filesystem::path(meshPath).parent_path()),
        witness_(witness),
        warnings_(warnings) {}

  void gltf(MeshPart& part);
  void mtl(MeshPart& part);

 private:
  struct Colour {
    double r, g, b;
  };
  Colour colour(const char* key, Colour initial) const {
    aiColor4D c(float(initial.r), float(initial.g), float(initial.b), 1);
    from_.Get(key, 0, 0, c);
    return {c.r, c.g, c.b};
  }
  double number(const char* key, double initial) const {
    float x = float(initial);
    from_.Get(key, 0, 0, x);
    return x;
  }

  std::shared_ptr<Block> block(const char* kind, const char* plugin) const {
    auto b = std::make_shared<Block>();
    b->kind = kind, b->plugin = plugin;  // no spans: it moves with the mesh, not with the text
    return b;
  }
  void set(Block& b, const char* name, Value value) const {
    b.settings.push_back({name, std::move(value), {}});
  }

  /// The texture's file, absolute; "" where there is none or none that can be used.
  std::string textureFile(aiTextureType type);
  const char* wrapOf(aiTextureType type) const;
  /// The texture times a factor as a pigment; the factor alone where there is no texture.
  Value looked(aiTextureType type, Colour factor, const char* channel, const char* colourSpace);
  void setColour(Block& b, const char* name, aiTextureType type, Colour factor) {
    set(b, name, looked(type, factor, "rgb", ""));
  }
  void setData(Block& b, const char* name, aiTextureType type, double factor, const char* channel) {
    Value v = looked(type, {factor, factor, factor}, channel, "raw");
    set(b, name, v.kind == Value::Kind::block ? v : numberValue(factor));
  }
  void setNormalMap(Block& b) {
    Value v = looked(aiTextureType_NORMALS, {1, 1, 1}, "rgb", "raw");
    if (v.kind == Value::Kind::block) set(b, "normal_map", v);
  }
  Value emission(double strength);

  const aiScene& scene_;
  const aiMaterial& from_;
  std::filesystem::path folder_;
  const Witness& witness_;
  std::vector<std::string>& warnings_;
};

/// "%20" and the like, as glTF writes blanks in names.
std::string decoded(const std::string& s) {
  std::string out;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s[i] == '%' && i + 2 < s.size() && std::isxdigit(static_cast<unsigned char>(s[i + 1])) &&
        std::isxdigit(static_cast<unsigned char>(s[i + 2]))) {
      out += char(std::stoi(s.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      out += s[i] == '\\' ? '/' : s[i];
    }
  }
  return out;
}

std::string Converter::textureFile(aiTextureType type) {
  aiString written;
  if (from_.GetTexture(type, 0, &written) != AI_SUCCESS || written.length == 0) return "";
  const std::string name = written.C_Str();
  if (name[0] == '*' || scene_.GetEmbeddedTexture(name.c_str())) {
    warnings_.push_back(
        "the mesh carries its images inside itself, which is not supported; plain colours are "
        "used in their place");
    return "";
  }
  for (const std::string& candidate : {name, decoded(name)}) {
    const std::filesystem::path file = std::filesystem::absolute(folder_ / candidate);
    witness_(file.lexically_normal().string());
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file.lexically_normal().string();
  }
  warnings_.push_back("the mesh's image \"" + decoded(name) +
                      "\" is not there; a plain colour is used in its place");
  return "";
}

const char* Converter::wrapOf(aiTextureType type) const {
  int mode = aiTextureMapMode_Wrap;
  from_.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), mode);
  if (mode == aiTextureMapMode_Mirror) return "mirror";
  return mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal ? "clamp" : "repeat";
}

Value Converter::looked(aiTextureType type, Colour factor, const char* channel,
                        const char* colourSpace) {
  const std::string file = textureFile(type);
  if (file.empty()) return colourValue(factor.r, factor.g, factor.b);
  const auto image = block("pigment", "image");
  set(*image, "file", textValue(file));
  set(*image, "wrap", textValue(wrapOf(type)));
  set(*image, "color_space", textValue(colourSpace));
  set(*image, "channel", textValue(channel));
  set(*image, "scale_value", colourValue(factor.r, factor.g, factor.b));
  Value v;
  v.kind = Value::Kind::block, v.block = image;
  return v;
}

Value Converter::emission(double strength) {
  Colour c = colour("$clr.emissive", {0, 0, 0});
  c = {c.r * strength, c.g * strength, c.b * strength};
  if (c.r <= 0 && c.g <= 0 && c.b <= 0) return {};
  return looked(aiTextureType_EMISSIVE, c, "rgb", "");
}

/// Metallic and roughness as the glTF 2.0 specification has them: g and b of one image.
void Converter::gltf(MeshPart& part) {
  const auto b = block("brdf", "principled");
  aiColor4D base(1, 1, 1, 1);
  from_.Get(AI_MATKEY_BASE_COLOR, base);
  aiString ignored;
  const aiTextureType colours =
      from_.GetTexture(aiTextureType_BASE_COLOR, 0, &ignored) == AI_SUCCESS
          ? aiTextureType_BASE_COLOR
          : aiTextureType_DIFFUSE;
  setColour(*b, "base_color", colours, {base.r, base.g, base.b});
  setData(*b, "metallic", aiTextureType_METALNESS, number("$mat.metallicFactor", 1), "b");
  setData(*b, "roughness", aiTextureType_DIFFUSE_ROUGHNESS, number("$mat.roughnessFactor", 1), "g");
  if (const double t = number("$mat.transmission.factor", 0); t > 0)
    setData(*b, "transmission", aiTextureType_TRANSMISSION, t, "r");
  set(*b, "ior", numberValue(std::max(0.1, number("$mat.refracti", 1.5))));
  setNormalMap(*b);
  aiString mode;
  from_.Get(AI_MATKEY_GLTF_ALPHAMODE, mode);
  const bool isMask = std::string(mode.C_Str()) == "MASK";
  if (isMask || std::string(mode.C_Str()) == "BLEND") setData(*b, "opacity", colours, base.a, "a");
  if (isMask)
    set(*b, "opacity_cutoff",
        numberValue(std::clamp(number("$mat.gltf.alphaCutoff", 0.5), 0., 1.)));
  part.brdf = b;
  part.emission = emission(number("$mat.emissiveIntensity", 1));
}

/// Kd, Ks, Ns, d, Ke and their maps. Without a highlight a lambert, else a principled whose width
/// gives the lobe of exponent Ns: alpha^2 = 2 / (Ns + 2) [Walter et al. 2007, Sec. 5.3].
void Converter::mtl(MeshPart& part) {
  const Colour specular = colour("$clr.specular", {0, 0, 0});
  const double exponent = number("$mat.shininess", 0);
  const bool shiny = exponent > 0 && specular.r + specular.g + specular.b > 0;
  const auto b = block("brdf", shiny ? "principled" : "lambert");
  aiString ignored;
  const bool mapped = from_.GetTexture(aiTextureType_DIFFUSE, 0, &ignored) == AI_SUCCESS;
  Colour kd = colour("$clr.diffuse", mapped ? Colour{1, 1, 1} : Colour{0.6, 0.6, 0.6});
  if (mapped && kd.r + kd.g + kd.b == 0) kd = {1, 1, 1};  // exporters write 0 beside a map
  setColour(*b, shiny ? "base_color" : "diffuse", aiTextureType_DIFFUSE, kd);
  if (shiny) {
    const double alpha = std::sqrt(2 / (exponent + 2));
    set(*b, "roughness", numberValue(std::sqrt(alpha)));
  }
  setNormalMap(*b);
  const double opacity = number("$mat.opacity", 1);
  const bool masked = from_.GetTexture(aiTextureType_OPACITY, 0, &ignored) == AI_SUCCESS;
  if (masked || opacity < 1) setData(*b, "opacity", aiTextureType_OPACITY, opacity, "r");
  part.brdf = b;
  part.emission = emission(1);
}

}  // namespace

void convertMaterial(const aiScene& scene, const aiMaterial& from, const std::string& meshPath,
                     const Witness& witness, MeshPart& part, std::vector<std::string>& warnings) {
  aiString name;
  from.Get(AI_MATKEY_NAME, name);
  part.name = name.C_Str();
  Converter converter(scene, from, meshPath, witness, warnings);
  const std::string kind = extensionOf(meshPath);
  if (kind == "gltf" || kind == "glb")
    converter.gltf(part);
  else if (kind == "obj" && part.name != AI_DEFAULT_MATERIAL_NAME)
    converter.mtl(part);
}

}  // namespace vestige::mesh
