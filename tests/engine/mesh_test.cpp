// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include "engine/trace/world.h"
#include "support/catch.h"
#include "support/shapes.h"

using namespace vestige;
using namespace vestige::test;

namespace {

/// A folder that is gone after the test.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("vestige-mesh-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

std::shared_ptr<Shape> load(const std::string& file, FakeHost& host,
                            std::map<std::string, Value> more = {}) {
  more["file"] = fileValue(file);
  return makeShape("mesh", more, &host);
}
std::shared_ptr<Shape> load(const std::string& file) {
  FakeHost host;
  return load(file, host);
}

std::size_t triangleCount(const Shape& s) {
  std::size_t n = 0;
  for (const MeshPart& p : *s.parts()) n += p.mesh.triangles.size();
  return n;
}

World worldOf(const std::shared_ptr<Shape>& s) {
  World w;
  for (const MeshPart& part : *s->parts()) {
    Placement p;
    p.shape = s, p.mesh = &part.mesh;
    w.add(p);
  }
  w.commit();
  return w;
}

/// Volume by the divergence theorem with cross(b - a, c - a) as normal: > 0 where that is outward.
double volume(const Shape& s) {
  double v = 0;
  for (const MeshPart& p : *s.parts())
    for (const auto& t : p.mesh.triangles) {
      const Vec3 a = p.mesh.positions[t[0]], b = p.mesh.positions[t[1]], c = p.mesh.positions[t[2]];
      v += double(dot(a, cross(b, c))) / 6;
    }
  return v;
}

/// Tetrahedron, counter-clockwise from outside in a right-handed world: volume 1/6.
const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

const Value& setting(const Block& b, const std::string& name) {
  const Value* v = b.find(name);
  if (!v) throw std::runtime_error("no setting " + name);
  return *v;
}

const std::string kPixel = "not read, only looked for";

}  // namespace

TEST_CASE("right-handed files are mirrored, outside stays outside", "[mesh]") {
  const Folder folder;
  const std::string file = folder.write("t.obj", kTetrahedron);
  const auto shape = load(file);
  CHECK(triangleCount(*shape) == 4);
  CHECK(volume(*shape) == Approx(1.0 / 6));
  Real low = 0, high = 0;
  for (const Vec3 p : shape->parts()->front().mesh.positions)
    low = std::min(low, p.z), high = std::max(high, p.z);
  CHECK(low == -1);
  CHECK(high == 0);
  FakeHost host;
  const auto left = load(file, host, {{"handedness", textValue("left")}});
  CHECK(volume(*left) == Approx(1.0 / 6));
  const World w = worldOf(left);
  CHECK(w.bounds().high.z == 1);
  CHECK(shape->parts()->front().brdf == nullptr);  // no material in the file
}

TEST_CASE("an OBJ file's materials become blocks", "[mesh]") {
  const Folder folder;
  folder.write("wood.png", kPixel);
  folder.write("m.mtl",
               "newmtl matt\nKd 0.5 0.25 1\nillum 1\n"
               "newmtl shiny\nKd 0.1 0.2 0.3\nKs 0.5 0.5 0.5\nNs 98\nd 0.75\nmap_Kd wood.png\n"
               "newmtl lamp\nKd 0 0 0\nKe 5 6 7\n"
               "newmtl lost\nKd 0.3 0.3 0.3\nmap_Kd gone.png\n");
  const std::string file =
      folder.write("m.obj",
                   "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                   "usemtl matt\nf 1/1 2/2 3/3\nusemtl shiny\nf 1/1 2/2 3/3\n"
                   "usemtl lamp\nf 1/1 2/2 3/3\nusemtl lost\nf 1/1 2/2 3/3\n");
  FakeHost host;
  const auto shape = load(file, host);
  std::map<std::string, const MeshPart*> parts;
  for (const MeshPart& p : *shape->parts()) parts[p.name] = &p;
  REQUIRE(parts.size() == 4);
  CHECK(parts["matt"]->brdf->kind == "brdf");
  CHECK(parts["matt"]->brdf->plugin == "lambert");
  CHECK(setting(*parts["matt"]->brdf, "diffuse").v[1] == Approx(0.25));
  CHECK(parts["matt"]->emission.kind == Value::Kind::none);
  const Block& shiny = *parts["shiny"]->brdf;
  CHECK(shiny.plugin == "principled");
  CHECK(setting(shiny, "opacity").v[0] == Approx(0.75));
  CHECK(setting(shiny, "roughness").v[0] == Approx(std::sqrt(std::sqrt(2.0 / 100))));
  const Value& map = setting(shiny, "base_color");
  REQUIRE(map.kind == Value::Kind::block);
  CHECK(map.block->kind == "pigment");
  CHECK(map.block->plugin == "image");
  CHECK(std::filesystem::path(setting(*map.block, "file").text.str()).is_absolute());
  CHECK_THAT(setting(*map.block, "file").text, containsText("wood.png"));
  CHECK(setting(*map.block, "wrap").text == "repeat");
  CHECK(setting(*map.block, "scale_value").v[1] == Approx(0.2));
  CHECK(parts["lamp"]->emission.v[2] == Approx(7));
  CHECK(setting(*parts["lost"]->brdf, "diffuse").kind == Value::Kind::colour);
  REQUIRE(host.warnings.size() == 1);
  CHECK_THAT(host.warnings[0], containsText("gone.png"));
}

TEST_CASE("a missing material file is told", "[mesh]") {
  const Folder folder;
  FakeHost host;
  load(folder.write("m.obj", std::string("mtllib away.mtl\n") + kTetrahedron), host);
  REQUIRE(host.warnings.size() == 1);
  CHECK_THAT(host.warnings[0], containsText("away.mtl"));
}

TEST_CASE("a PLY file keeps its normals and the uv that it calls s and t", "[mesh]") {
  const Folder folder;
  const auto shape = load(
      folder.write("p.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                   "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                   "property float s\nproperty float t\nelement face 1\n"
                   "property list uchar uint vertex_indices\nend_header\n"
                   "0 0 0 0 0 1 0.25 0.5\n1 0 0 0 0 1 0.75 0.5\n0 1 0 0 1 1 0.25 1\n3 0 1 2\n"));
  const TriangleMesh& m = shape->parts()->front().mesh;
  REQUIRE(m.uvs.size() == 3);
  REQUIRE(m.normals.size() == 3);
  const World w = worldOf(shape);
  // Counter-clockwise towards +z in the file, so seen from -z here.
  const auto s = w.intersect({{Real(0.2), Real(0.2), -3}, {0, 0, 1}, 0, kInfinity});
  REQUIRE(s);
  CHECK(s->geometricNormal.z == Approx(-1));
  CHECK(s->normal.z < Real(-0.9));
  CHECK(s->uv.x == Approx(0.35));
  CHECK(s->uv.y == Approx(0.6));
  CHECK(s->dPdu.x == Approx(2));
}

TEST_CASE("an STL file is flat unless it is asked to be smooth", "[mesh]") {
  const Folder folder;
  const std::string text =
      "solid a\n"
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\n"
      "facet normal 0 0.2 1\nouter loop\nvertex 1 0 0\nvertex 1 1 -0.2\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid a\n";
  const std::string file = folder.write("a.stl", text);
  CHECK(load(file)->parts()->front().mesh.normals.empty());
  FakeHost host;
  const auto smooth = load(file, host, {{"smooth", number(1)}});
  const TriangleMesh& m = smooth->parts()->front().mesh;
  REQUIRE(!m.normals.empty());
  for (const Vec3 n : m.normals) CHECK(n.z < Real(-0.9));  // mirrored
  const auto sharp = load(file, host, {{"smooth", number(1)}, {"smooth_angle", number(1)}});
  CHECK(sharp->parts()->front().mesh.positions.size() == 6);
}

TEST_CASE("a glTF mask is a cut-out at its cutoff", "[mesh]") {
  const Folder folder;
  const float data[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  folder.write("t.bin", std::string(reinterpret_cast<const char*>(data), sizeof data));
  const auto cutoff = [&](const std::string& mode) {
    const std::string file = folder.write("t.gltf", R"({"asset":{"version":"2.0"},
      "buffers":[{"uri":"t.bin","byteLength":36}],
      "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
        "min":[0,0,0],"max":[1,1,0]}],
      "materials":[{)" + mode + R"("pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.3]}}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
      "nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0})");
    FakeHost host;
    const auto shape = load(file, host);
    const Value* v = shape->parts()->front().brdf->find("opacity_cutoff");
    return v ? v->v[0] : -1;
  };
  CHECK(cutoff(R"("alphaMode":"MASK","alphaCutoff":0.2,)") == Approx(0.2));
  CHECK(cutoff(R"("alphaMode":"MASK",)") == Approx(0.5));  // glTF 2.0, 3.9.4
  CHECK(cutoff(R"("alphaMode":"BLEND",)") == -1);
  CHECK(cutoff("") == -1);
}

TEST_CASE("a glTF file brings its nodes, materials and textures", "[mesh]") {
  const Folder folder;
  folder.write("base colour.png", kPixel), folder.write("orm.png", kPixel);
  folder.write("n.png", kPixel);
  // One triangle: positions, uv, indices; base64 of little-endian floats.
  const float data[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
  std::string bin(reinterpret_cast<const char*>(data), sizeof data);
  bin += std::string("\0\0\1\0\2\0", 6);
  folder.write("t.bin", bin);
  const std::string file = folder.write("t.gltf", R"({"asset":{"version":"2.0"},
    "buffers":[{"uri":"t.bin","byteLength":66}],
    "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},
      {"buffer":0,"byteOffset":36,"byteLength":24},{"buffer":0,"byteOffset":60,"byteLength":6}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
        "min":[0,0,0],"max":[1,1,0]},
      {"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},
      {"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"}],
    "images":[{"uri":"base%20colour.png"},{"uri":"orm.png"},{"uri":"n.png"}],
    "samplers":[{"wrapS":33071,"wrapT":33071}],
    "textures":[{"source":0,"sampler":0},{"source":1},{"source":2}],
    "materials":[{"name":"stuff","alphaMode":"BLEND","pbrMetallicRoughness":{
        "baseColorFactor":[0.5,0.25,1,0.8],"baseColorTexture":{"index":0},
        "metallicFactor":0.9,"roughnessFactor":0.4,"metallicRoughnessTexture":{"index":1}},
      "normalTexture":{"index":2},"emissiveFactor":[1,0.5,0]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,
      "material":0}]}],
    "nodes":[{"mesh":0,"translation":[10,0,4]},{"mesh":0,"scale":[-2,1,1]}],
    "scenes":[{"nodes":[0,1]}],"scene":0})");
  FakeHost host;
  const auto shape = load(file, host);
  for (const std::string& w : host.warnings) CHECK(w == "");
  CHECK(triangleCount(*shape) == 2);
  REQUIRE(shape->parts()->size() == 1);
  const MeshPart& part = shape->parts()->front();
  CHECK(part.name == "stuff");
  const Block& b = *part.brdf;
  CHECK(b.plugin == "principled");
  const auto image = [&](const char* name) -> const Block& {
    const Value& v = setting(b, name);
    if (!v.block) throw std::runtime_error(std::string(name) + " is no pigment");
    return *v.block;
  };
  CHECK_THAT(setting(image("base_color"), "file").text, containsText("base colour.png"));
  CHECK(setting(image("base_color"), "wrap").text == "clamp");
  CHECK(setting(image("base_color"), "scale_value").v[1] == Approx(0.25));
  CHECK_THAT(setting(image("roughness"), "file").text, containsText("orm.png"));
  CHECK(setting(image("roughness"), "channel").text == "g");
  CHECK(setting(image("roughness"), "color_space").text == "raw");
  CHECK(setting(image("roughness"), "scale_value").v[0] == Approx(0.4));
  CHECK(setting(image("metallic"), "channel").text == "b");
  CHECK(setting(image("metallic"), "scale_value").v[0] == Approx(0.9));
  CHECK(setting(image("opacity"), "channel").text == "a");
  CHECK(setting(image("opacity"), "scale_value").v[0] == Approx(0.8));
  CHECK(!b.find("opacity_cutoff"));
  CHECK(setting(image("normal_map"), "color_space").text == "raw");
  CHECK(part.emission.v[1] == Approx(0.5));
  const World w = worldOf(shape);
  // The node at x = 10, z = 4 (-4 here); its face looks to -z as in the file to +z.
  const auto s = w.intersect({{Real(10.25), Real(0.125), -9}, {0, 0, 1}, 0, kInfinity});
  REQUIRE(s);
  CHECK(s->position.z == Approx(-4));
  CHECK(s->geometricNormal.z == Approx(-1));
  // The file says (0.25, 0.125), v counted from the top.
  CHECK(s->uv.x == Approx(0.25));
  CHECK(s->uv.y == Approx(0.875));
  // A node that mirrors turns no face over.
  const auto m = w.intersect({{Real(-0.5), Real(0.5), -9}, {0, 0, 1}, 0, kInfinity});
  REQUIRE(m);
  CHECK(m->geometricNormal.z == Approx(-1));
}

TEST_CASE("files that are no meshes are refused in words", "[mesh]") {
  const Folder folder;
  const auto why = [](const std::string& file) {
    return whyRefused("mesh", {{"file", fileValue(file)}});
  };
  CHECK_THAT(why("nowhere.obj"), containsText("nowhere.obj"));
  CHECK_THAT(why(folder.write("empty.obj", "")), containsText("is empty"));
  CHECK_THAT(why(folder.write("a.txt", "hello")), containsText("unknown kind"));
  CHECK_THAT(why(folder.write("a.obj", "# nothing here at all, only words in a comment\n")),
             containsText("obj"));
  CHECK_THAT(why(folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n")),
             containsText("obj"));
  CHECK_THAT(why(folder.write("bad.ply", "ply\nformat ascii 1.0\nelement vertex 9\n")),
             containsText("PLY"));
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar uint vertex_indices\nend_header\n"
      "0 0 0\n";
  CHECK_THAT(why(folder.write("short.ply", head)), containsText("cut short"));
  CHECK_THAT(why(folder.write("range.ply", head + "1 0 0\n0 1 0\n3 0 1 9\n")),
             containsText("names corner 9"));
  CHECK_THAT(why(folder.write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")),
             containsText("OBJ"));
  CHECK_THAT(why(folder.write("bad.gltf", "{\"asset\":")), containsText("GLTF"));
  CHECK_THAT(why(folder.write("bad.glb", "glTF....")), containsText("GLB"));
  CHECK_THAT(why(folder.write("bad.stl", "solid nothing")), containsText("stl"));
}

TEST_CASE("corners that are no numbers cost their triangles only", "[mesh]") {
  const Folder folder;
  FakeHost host;
  const auto shape = load(folder.write("n.ply",
                                       "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                                       "property float y\nproperty float z\nelement face 2\n"
                                       "property list uchar uint vertex_indices\nend_header\n"
                                       "0 0 0\n1 0 0\n0 1 0\nnan 0 0\n3 0 1 2\n3 0 1 3\n"),
                          host);
  CHECK(triangleCount(*shape) == 1);
  REQUIRE(host.warnings.size() == 1);
  CHECK_THAT(host.warnings[0], containsText("1 triangle"));
}

TEST_CASE("spot is whole", "[mesh]") {
  FakeHost host;
  const auto spot = load(VESTIGE_SOURCE_DIR "/examples/assets/spot/spot_triangulated.obj", host);
  CHECK(triangleCount(*spot) == 5856);
  CHECK(volume(*spot) > 0);
  REQUIRE(!spot->parts()->front().mesh.uvs.empty());
  const World w = worldOf(spot);
  CHECK(w.dropped() == 0);
  // Watertight: from inside every ray meets the back of something.
  Random random(2);
  int out = 0;
  for (int k = 0; k < 2000; ++k) {
    const auto s = w.intersect({{0, 0, Real(-0.1)}, random.direction(), 0, kInfinity});
    out += !s || dot(s->geometricNormal, s->position - Vec3{0, 0, Real(-0.1)}) < 0;
  }
  CHECK(out == 0);
}

namespace {

/// A picture given as numbers, row 0 at the bottom.
struct Picture final : Texture {
  int w, h;
  std::vector<Real> v;
  Picture(int width, int height, std::vector<Real> values) : w(width), h(height), v(values) {}
  Rgba lookup(Vec2, const Vec2[2]) const noexcept override { return {}; }
  Rgba texel(int x, int y) const noexcept override { return {grey(v[std::size_t(y * w + x)]), 1}; }
  int width() const noexcept override { return w; }
  int height() const noexcept override { return h; }
  bool hasAlpha() const noexcept override { return false; }
  Rgba mean() const noexcept override { return {}; }
};

Real heightAt(const World& w, Real x, Real z) {
  const auto s = w.intersect({{x, 5, z}, {0, -1, 0}, 0, kInfinity});
  return s ? s->position.y : Real(-1);
}

}  // namespace

TEST_CASE("a height field lies over the unit square as its picture", "[height_field]") {
  FakeHost host;
  // A ramp along x with one peak at the upper right corner.
  host.textures["p"] = std::make_shared<Picture>(3, 2,
                                                 std::vector<Real>{0, Real(0.25), Real(0.5),  //
                                                                   0, Real(0.25), 1});
  const auto field = [&](std::map<std::string, Value> more) {
    more["file"] = fileValue("p");
    return makeShape("height_field", more, &host);
  };
  const World w = worldOf(field({}));
  CHECK(w.triangles() == 4);
  CHECK(heightAt(w, Real(0.25), Real(0.1)) == Approx(0.125));
  CHECK(heightAt(w, Real(0.999), Real(0.999)) == Approx(1).margin(0.01));
  CHECK(heightAt(w, Real(0.999), Real(0.001)) == Approx(0.5).margin(0.01));
  const auto s = w.intersect({{Real(0.25), 5, Real(0.25)}, {0, -1, 0}, 0, kInfinity});
  REQUIRE(s);
  CHECK(s->geometricNormal.y > 0);
  CHECK(s->uv.x == Approx(0.25));
  const World wet = worldOf(field({{"water_level", number(0.125)}}));
  CHECK(heightAt(wet, Real(0.24), Real(0.3)) == -1);
  CHECK(heightAt(wet, Real(0.26), Real(0.3)) == Approx(0.13));
  const auto bent = worldOf(field({{"smooth", number(1)}}))
                        .intersect({{Real(0.8), 5, Real(0.4)}, {0, -1, 0}, 0, kInfinity});
  REQUIRE(bent);
  CHECK(length(bent->dNdu) > 0);
  CHECK_THAT(whyRefused("height_field", {{"file", fileValue("q")}}, &host),
             containsText("no image"));
  host.textures["p"] = std::make_shared<Picture>(1, 1, std::vector<Real>{0});
  CHECK_THAT(whyRefused("height_field", {{"file", fileValue("p")}}, &host), containsText("2 x 2"));
}
