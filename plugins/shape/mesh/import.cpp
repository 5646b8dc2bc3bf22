// SPDX-License-Identifier: Apache-2.0
#include "import.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <tuple>

#include <assimp/config.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <vestige/tools/regular_file.h>

#include "material.h"

namespace vestige::mesh {
namespace {

/// Assimp's way to files, with a witness: some meshes name others.
class WitnessedFiles final : public Assimp::DefaultIOSystem {
 public:
  explicit WitnessedFiles(const Witness& witness) : witness_(witness) {}
  bool Exists(const char* file) const override {
    witness_(file);
    return whyNotRegular(file).empty();  // the base class opens it, which waits for a pipe
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    witness_(file);
    return whyNotRegular(file).empty() ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

 private:
  const Witness& witness_;
};

/// Meshes of one material go into one part, unless only some have normals or uv.
using PartKey = std::tuple<unsigned, bool, bool>;

struct Gather {
  const aiScene& scene;
  const Options& options;
  std::map<PartKey, TriangleMesh> meshes;

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
    if (t[0] != t[1] || t[1] != t[2]) to.triangles.push_back(t);
  }
}

/// Assimp never returns from a PLY file whose header has no end.
bool hasPlyHeader(std::ifstream& in) {
  std::string line;
  for (int k = 0; k < 1000 && std::getline(in, line); ++k)
    if (line.rfind("end_header", 0) == 0) return true;
  return false;
}

/// Readable, not empty, of a kind that is known: said before Assimp says it its own way.
void checkFile(const std::string& path, const Assimp::Importer& importer) {
  std::string why;
  std::ifstream in = openRegular(path, why);
  if (!in) throw ReadError(why);
  if (in.peek() == std::ifstream::traits_type::eof()) throw ReadError("is empty");
  const std::string extension = extensionOf(path);
  if (extension.empty() || !importer.IsExtensionSupported("." + extension))
    throw ReadError(
        "is of an unknown kind, expected a name that ends in .obj, .ply, .stl, .gltf "
        "or .glb");
  if (extension == "ply" && !hasPlyHeader(in))
    throw ReadError("cannot be read: it is damaged or is no PLY file (its header has no end)");
}

/// What Assimp's readers let pass and its later steps fall over: a PLY file that was cut short, or
/// whose faces name corners that it does not have.
void checkFaces(const aiScene& scene) {
  for (unsigned k = 0; k < scene.mNumMeshes; ++k) {
    const aiMesh& m = *scene.mMeshes[k];
    for (unsigned f = 0; f < m.mNumFaces; ++f) {
      const aiFace& face = m.mFaces[f];
      if (face.mNumIndices == 0)
        throw ReadError("is cut short: face " + std::to_string(f + 1) + " has no corners");
      for (unsigned j = 0; j < face.mNumIndices; ++j)
        if (face.mIndices[j] >= m.mNumVertices)
          throw ReadError("is damaged: face " + std::to_string(f + 1) + " names corner " +
                          std::to_string(face.mIndices[j]) + ", counted from 0, of " +
                          std::to_string(m.mNumVertices));
    }
  }
}

/// Takes the faces out that have a corner which is no number, before Assimp joins that corner with
/// whatever it compares it to; they stay behind as points, for a mesh must not be empty. How many.
std::size_t flattenBrokenFaces(aiScene& scene) {
  std::size_t count = 0;
  for (unsigned k = 0; k < scene.mNumMeshes; ++k) {
    aiMesh& m = *scene.mMeshes[k];
    const auto broken = [&](unsigned i) { return !isFinite(vector(m.mVertices[i], false)); };
    for (unsigned f = 0; f < m.mNumFaces; ++f) {
      aiFace& face = m.mFaces[f];
      if (face.mNumIndices < 3 ||
          std::none_of(face.mIndices, face.mIndices + face.mNumIndices, broken))
        continue;
      count += face.mNumIndices - 2;
      face.mNumIndices = 3;
      std::fill_n(face.mIndices, 3, face.mIndices[0]);
    }
    for (unsigned i = 0; i < m.mNumVertices; ++i)
      if (broken(i)) m.mVertices[i] = aiVector3D();
  }
  return count;
}

/// An OBJ file names its materials' file; where that is missing they are all grey.
void warnOfMissingMaterials(const std::string& path, const Witness& witness,
                            std::vector<std::string>& warnings) {
  std::ifstream in(path);
  std::string line;
  for (int k = 0; k < 200 && std::getline(in, line); ++k) {
    if (line.rfind("mtllib ", 0) != 0) continue;
    std::string name = line.substr(7);
    name.erase(name.find_last_not_of(" \t\r\n") + 1);
    const std::filesystem::path file = std::filesystem::path(path).parent_path() / name;
    witness(file.string());
    if (!std::filesystem::exists(file))
      warnings.push_back("the mesh's material file \"" + name + "\" is not beside it");
  }
}

/// Whether faces share their corners already, as in most files.
bool sharesCorners(const aiScene& scene) {
  return std::all_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes,
                     [](const aiMesh* m) { return m->mNumVertices < 2 * m->mNumFaces; });
}

/// The flags are few on purpose: each step costs time on large meshes.
unsigned prepare(Assimp::Importer& importer, const aiScene& scene, const std::string& path,
                 const Options& options) {
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType;
  // Half of the time that a million triangles take; where they are shared it joins next to nothing.
  if (options.smooth || !sharesCorners(scene)) steps |= aiProcess_JoinIdenticalVertices;
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

std::string whyUnreadable(const std::string& path) {
  std::string kind = extensionOf(path);
  const bool others = kind == "gltf";
  std::transform(kind.begin(), kind.end(), kind.begin(), ::toupper);
  return std::string("cannot be read: it is damaged") +
         (others ? ", a file that it names is missing," : "") + " or is no " + kind + " file";
}

}  // namespace

std::string extensionOf(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  if (!e.empty()) e.erase(0, 1);
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

Imported import(const std::string& path, const Options& options, const Witness& witness) {
  Assimp::Importer importer;
  importer.SetIOHandler(new WitnessedFiles(witness));  // which it deletes
  checkFile(path, importer);
  Imported made;
  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene && scene->mRootNode) {
    checkFaces(*scene);
    made.dropped = flattenBrokenFaces(const_cast<aiScene&>(*scene));
    scene = importer.ApplyPostProcessing(prepare(importer, *scene, path, options));
  }
  if (!scene || !scene->mRootNode) throw ReadError(whyUnreadable(path));
  Gather gather{*scene, options, {}};
  gather.node(*scene->mRootNode, aiMatrix4x4());
  for (auto& [key, triangles] : gather.meshes) {
    if (triangles.triangles.empty()) continue;
    MeshPart& part = made.parts.emplace_back();
    part.mesh = std::move(triangles);
    convertMaterial(*scene, *scene->mMaterials[std::get<0>(key)], path, witness, part,
                    made.warnings);
  }
  if (made.parts.empty()) throw ReadError("holds no triangles");
  if (extensionOf(path) == "obj") warnOfMissingMaterials(path, witness, made.warnings);
  std::sort(made.warnings.begin(), made.warnings.end());
  made.warnings.erase(std::unique(made.warnings.begin(), made.warnings.end()), made.warnings.end());
  return made;
}

}  // namespace vestige::mesh
