// SPDX-License-Identifier: Apache-2.0
// Files that wait, that never end, or that claim more than they hold: an error at their place.
#include <sys/stat.h>

#include "app/run.h"
#include "support/catch.h"
#include "support/small_png.h"

namespace {

// Sanitizers reserve terabytes of addresses for themselves, which no limit allows.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr long kMemory = -1;
#else
constexpr long kMemory = 3L << 30;
#endif

/// A scene that names a file in one of the ways that open it.
const char* const kUses[] = {
    "sphere { 0, 1 brdf lambert { diffuse pigment image { \"FILE\" } } }",
    "height_field { \"FILE\" }",
    "mesh { \"FILE\" }",
    "light environment { map \"FILE\" }",
};

std::string use(std::string text, const std::string& file) {
  return smallScene(text.replace(text.find("FILE"), 4, file).c_str());
}

void mustRefuse(const Folder& folder, const std::string& text, const std::string& why) {
  const Run r = runVestige({"check", folder.write("a.scene", text)},
                           {.folder = folder.path(), .memoryLimit = kMemory, .patience = 20});
  INFO(text << '\n' << r.err);
  CHECK(r.exit == 1);
  CHECK_THAT(r.err, containsText("a.scene:5:") && containsText("error: ") && containsText(why));
}

std::string bomb(std::uint32_t width, std::uint32_t height) {
  std::string header;
  vestige::test::png::put32(header, width);
  vestige::test::png::put32(header, height);
  header += std::string("\x08\x00\x00\x00\x00", 5);  // eight bits of grey
  return "\x89PNG\r\n\x1a\n" + vestige::test::png::chunk("IHDR", header) +
         vestige::test::png::chunk("IDAT", vestige::test::png::zlib("none"));
}

}  // namespace

TEST_CASE("pipes, devices and endless files are refused, not waited for", "[app]") {
  const Folder folder;
  REQUIRE(mkfifo((folder / "pipe.png").c_str(), 0600) == 0);
  REQUIRE(mkfifo((folder / "pipe.obj").c_str(), 0600) == 0);
  for (const char* text : kUses) {
    const std::string name = std::string(text).rfind("mesh", 0) == 0 ? "pipe.obj" : "pipe.png";
    mustRefuse(folder, use(text, name), "is a pipe or a device");
    mustRefuse(folder, use(text, "/dev/zero"), "is a pipe or a device");
    mustRefuse(folder, use(text, "/proc/kmsg"), "is a file of the system");
    mustRefuse(folder, use(text, "/proc"), "is a folder");
  }
  mustRefuse(folder, use("#include \"FILE\"", "/proc/kmsg"), "is a file of the system");
  mustRefuse(folder, use("#include \"FILE\"", "pipe.png"), "pipe.png");
}

TEST_CASE("pipes on the command line are refused, too", "[app]") {
  const Folder folder;
  const std::string pipe = folder / "pipe", picture = folder / "a.png";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const std::string scene = folder.write("a.scene", smallScene("integrator particle { }"));
  const std::vector<std::string> commands[] = {
      {"check", pipe},
      {"compare", pipe, pipe},
      {scene, "-o", picture, "--spp", "1", "--checkpoint", pipe},
      {scene, "-o", picture, "--load-solution", pipe},
  };
  for (const std::vector<std::string>& command : commands) {
    const Run r = runVestige(command, {.folder = folder.path(), .patience = 20});
    INFO(command[0] << ' ' << command.back() << '\n' << r.err);
    CHECK(r.exit > 0);
    CHECK_THAT(r.err, containsText("is a pipe or a device"));
  }
}

TEST_CASE("a mesh that names a pipe as its materials is read without them", "[app]") {
  const Folder folder;
  REQUIRE(mkfifo((folder / "pipe.mtl").c_str(), 0600) == 0);
  folder.write("a.obj", "mtllib pipe.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Run r = runVestige({"check", folder.write("a.scene", smallScene("mesh { \"a.obj\" }"))},
                           {.folder = folder.path(), .patience = 20});
  INFO(r.err);
  CHECK(r.exit == 0);
}

TEST_CASE("a small file that claims a huge picture is refused", "[app]") {
  const Folder folder;
  folder.write("20000.png", bomb(20000, 20000));
  folder.write("60000.png", bomb(60000, 60000));
  for (const char* text : {kUses[0], kUses[1], kUses[3]})
    for (const char* file : {"20000.png", "60000.png"})
      mustRefuse(folder, use(text, file), "--max-picture");
}

TEST_CASE("models that claim more than they hold are refused", "[app]") {
  const Folder folder;
  const std::string mesh = "mesh { \"FILE\" }";
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::pair<const char*, std::string> files[] = {
      {"vertices.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 2147483648\nproperty float x\n"
       "property float y\nproperty float z\nelement face 1\nproperty list uchar int "
       "vertex_indices\nend_header\n"},
      {"facets.stl", std::string(80, ' ') + "\xff\xff\xff\xff" + std::string(50, '\0')},
      {"index.obj", corners + "f 1 2 2147483647\n"},
      {"buffer.gltf",
       R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4000000000,"uri":"none.bin"}]})"},
      {"loop.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
                    R"("nodes":[{"children":[1]},{"children":[0]}]})"},
  };
  for (const auto& [name, contents] : files) {
    folder.write(name, contents);
    mustRefuse(folder, use(mesh, name), name);
  }
  folder.write("wide.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n");
  mustRefuse(folder, use(kUses[0], "wide.hdr"), "wide.hdr");
}

TEST_CASE("includes that are no texts are refused", "[app]") {
  const Folder folder;
  const std::string include = "#include \"FILE\"";
  for (const char* file : {"/dev/zero", "/dev/stdin", "/", "/proc/self/pagemap", "/proc/self/mem"})
    mustRefuse(folder, use(include, file), file);
  mustRefuse(folder, use(include, "a.scene"), "includes itself");
}

TEST_CASE("a height field has a greatest size", "[app]") {
  const Folder folder;
  folder.write("a.pbm", "P4\n4100 4100\n" + std::string(4104 / 8 * 4100, '\x55'));
  mustRefuse(folder, use("height_field { \"FILE\" }", "a.pbm"), "4096 x 4096");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("a film larger than the memory is refused before it is filled", "[app]") {
  const Folder folder;
  const std::string scene =
      folder.write("a.scene",
                   "camera pinhole { location <0, 0, -3> look_at 0 }\nlight point { location "
                   "<0, 5, 0> intensity 1 }\nfilm { resolution <16384, 16384> }\nsphere { 0, 1 }");
  const Run r = runVestige({scene, "-o", folder / "a.png", "--spp", "1"},
                           {.folder = folder.path(), .memoryLimit = 4L << 30, .patience = 60});
  INFO(r.err);
  CHECK(r.exit == 3);
  CHECK_THAT(r.err, containsText("16384 x 16384") && containsText("4.3 GB"));
}
#endif

TEST_CASE("no message carries a terminal's escape", "[app]") {
  const Folder folder;
  const std::string escape = "\x1b[2J\x1b]0;title\x07\xc2\x9b";
  for (const std::string& text :
       {"#error \"" + escape + "\"", "#warning \"" + escape + "\"", "#debug \"" + escape + "\"",
        "#include \"" + escape + "\"", "film { filter \"" + escape + "\" }",
        "mesh { \"" + escape + "\" }"}) {
    const Run r = runVestige({"check", folder.write("a.scene", smallScene(text.c_str()))});
    INFO(text);
    CHECK_THAT(r.err, containsText("2J"));
    CHECK(r.err.find('\x1b') == std::string::npos);
    CHECK(r.err.find("\xc2\x9b") == std::string::npos);
  }
}
