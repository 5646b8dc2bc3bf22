// SPDX-License-Identifier: Apache-2.0
#include "import.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <tuple>

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "material.h"

namespace vestige::mesh {
namespace {

/// Meshes of one material go into one part, unless only some have normals or uv.
using PartKey = std::tuple<unsigned, bool, bool>;

struct Gather {
  const aiScene& scene;
  const Options& options;
  std::map<PartKey, TriangleMesh> meshes;
  std::size_t dropped = 0;

  void node(const aiNode& n, const aiMatrix4x4& above);
  void mesh(const aiMesh& m, const aiMatrix4x4& toFile);
};

Vec3 vector(const aiVector3D& v, bool mirror) {
  return {Real(v.x), Real(v.y), Real(mirror ? -v.z : v.z)};
}

void Gather::node(const aiNode& n, const aiMatrix4x4& above) {
  const aiMatrix4x4 toFile = above * n.mTransformation;
  for (unsigned k = 0; k < n.mNumMeshes; ++k) mesh(*scene.mMeshes[n.mMeshes[k]], toFile);
  for (unsigned k = 0; k < n.mNumChildren; ++k) node(*n.mChildren[k], toFile);
}

void Gather::mesh(const aiMesh& m, const aiMatrix4x4& toFile) {
  const bool hasNormals = m.HasNormals(), hasUvs = m.HasTextureCoords(0);
  TriangleMesh& to = meshes[{m.mMaterialIndex, hasNormals, hasUvs}];
  const auto first = std::uint32_t(to.positions.size());
  const aiMatrix3x3 linear(toFile);
  aiMatrix3x3 forNormals = linear;
  forNormals.Inverse().Transpose();
  for (unsigned i = 0; i < m.mNumVertices; ++i) {
    to.positions.push_back(vector(toFile * m.mVertices[i], options.mirror));
    if (hasNormals) {
      const Vec3 n = normalize(vector(forNormals * m.mNormals[i], options.mirror));
      to.normals.push_back(isFinite(n) ? n : Vec3{});  // of no length: the engine shades flat
    }
    if (hasUvs) {
      const Vec2 uv{Real(m.mTextureCoords[0][i].x), Real(m.mTextureCoords[0][i].y)};
      to.uvs.push_back(std::isfinite(uv.x + uv.y) ? uv : Vec2{});
    }
  }
  // Turned over once by the file's own mirroring transform, once by our change of hand.
  const bool flip = options.mirror != (linear.Determinant() < 0);
  for (unsigned k = 0; k < m.mNumFaces; ++k) {
    const aiFace& f = m.mFaces[k];
    if (f.mNumIndices != 3) continue;
    std::array<std::uint32_t, 3> t{first + f.mIndices[0], first + f.mIndices[1],
                                   first + f.mIndices[2]};
    if (flip) std::swap(t[1], t[2]);
    const auto finite = [&](std::uint32_t i) { return isFinite(to.positions[i]); };
    if (std::all_of(t.begin(), t.end(), finite))
      to.triangles.push_back(t);
    else
      ++dropped;
  }
}

/// Readable, not empty, of a kind that is known: said before Assimp says it its own way.
void checkFile(const std::string& path, const Assimp::Importer& importer) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) throw ReadError("cannot be opened");
  if (in.peek() == std::ifstream::traits_type::eof()) throw ReadError("is empty");
  const std::string extension = extensionOf(path);
  if (extension.empty() || !importer.IsExtensionSupported("." + extension))
    throw ReadError(
        "is of an unknown kind, expected a name that ends in .obj, .ply, .stl, .gltf "
        "or .glb");
}

/// An OBJ file names its materials' file; where that is missing they are all grey.
void warnOfMissingMaterials(const std::string& path, std::vector<std::string>& warnings) {
  std::ifstream in(path);
  std::string line;
  for (int k = 0; k < 200 && std::getline(in, line); ++k) {
    if (line.rfind("mtllib ", 0) != 0) continue;
    std::string name = line.substr(7);
    name.erase(name.find_last_not_of(" \t\r\n") + 1);
    if (!std::filesystem::exists(std::filesystem::path(path).parent_path() / name))
      warnings.push_back("the mesh's material file \"" + name + "\" is not beside it");
  }
}

/// The flags are few on purpose: each step costs time on large meshes.
unsigned prepare(Assimp::Importer& importer, const std::string& path, const Options& options) {
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  unsigned steps = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType;
  if (options.smooth) {
    importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, float(options.smoothAngle));
    steps |= aiProcess_GenSmoothNormals;
  }
  if (extensionOf(path) == "stl") {  // its normals only repeat the faces
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS);
    steps |= aiProcess_RemoveComponent;
  }
  return steps;
}

}  // namespace

std::string extensionOf(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  if (!e.empty()) e.erase(0, 1);
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

Imported import(const std::string& path, const Options& options, Span span) {
  Assimp::Importer importer;
  checkFile(path, importer);
  const aiScene* scene = importer.ReadFile(path, prepare(importer, path, options));
  if (!scene || !scene->mRootNode) {
    std::string kind = extensionOf(path);
    std::transform(kind.begin(), kind.end(), kind.begin(), ::toupper);
    const bool others = kind == "GLTF";
    throw ReadError("cannot be read: it is damaged" +
                    std::string(others ? ", a file that it names is missing," : "") + " or is no " +
                    kind + " file");
  }
  Gather gather{*scene, options, {}, 0};
  gather.node(*scene->mRootNode, aiMatrix4x4());
  Imported made;
  made.dropped = gather.dropped;
  for (auto& [key, triangles] : gather.meshes) {
    if (triangles.triangles.empty()) continue;
    MeshPart& part = made.parts.emplace_back();
    part.mesh = std::move(triangles);
    convertMaterial(*scene, *scene->mMaterials[std::get<0>(key)], path, span, part, made.warnings);
  }
  if (made.parts.empty()) throw ReadError("holds no triangles");
  if (extensionOf(path) == "obj") warnOfMissingMaterials(path, made.warnings);
  std::sort(made.warnings.begin(), made.warnings.end());
  made.warnings.erase(std::unique(made.warnings.begin(), made.warnings.end()), made.warnings.end());
  return made;
}

}  // namespace vestige::mesh
