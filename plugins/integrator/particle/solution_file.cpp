// SPDX-License-Identifier: Apache-2.0
#include "solution_file.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include <vestige/tools/regular_file.h>

namespace vestige::particle {
namespace {

// Text lines for people, then elements as little-endian numbers: for each root and cluster that has
// anything, its id and its tree (depth first: flux, hits, whether it is divided); id 0 ends.
constexpr const char* kFirstLine = "vestige radiosity solution 1";

/// More than integrator particle takes.
constexpr std::uint64_t kMostParticles = std::uint64_t(1) << 32;

struct Record {
  std::int64_t flux[3];
  std::uint32_t hits;
  std::uint32_t isDivided;
};
static_assert(sizeof(Record) == 32);

[[noreturn]] void fail(const std::string& file, const std::string& why) {
  throw std::runtime_error("solution '" + file + "' " + why);
}

bool isEmpty(const Element& e) noexcept { return e.hits() == 0 && e.children == 0; }

void writeTree(std::ofstream& out, const Hierarchy& h, ElementId id) {
  const Element& e = h.elements()[id];
  const ElementId first = e.children;
  const Flux f = e.sum();
  const Record r{{f[0], f[1], f[2]}, std::uint32_t(e.hits()), first != 0};
  out.write(reinterpret_cast<const char*>(&r), sizeof r);
  for (int k = 0; first != 0 && k < 4; ++k) writeTree(out, h, first + ElementId(k));
}

/// False where the file ends or makes no sense.
bool readTree(std::ifstream& in, Hierarchy& h, ElementId id, int patch, const Cell& cell,
              int depth) {
  Record r;
  if (!in.read(reinterpret_cast<char*>(&r), sizeof r) || depth > 30) return false;
  Element& e = h.elements()[id];
  for (int c = 0; c < 3; ++c) e.flux[c] += r.flux[c];
  e.quarter[0] += r.hits;
  if (!r.isDivided) return true;
  if (patch < 0) return false;
  const ElementId first = h.divide(id, patch, cell);
  for (int k = 0; k < 4; ++k)
    if (!readTree(in, h, first + ElementId(k), patch, cell.child(k), depth + 1)) return false;
  return true;
}

void mix(std::uint64_t& h, const void* data, std::size_t size) noexcept {  // FNV-1a
  for (std::size_t i = 0; i < size; ++i)
    h = (h ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3u;
}

std::string partial(const std::string& file) { return file + ".part"; }

}  // namespace

std::uint64_t fingerprint(const SceneView& scene, const Hierarchy& hierarchy) noexcept {
  std::uint64_t h = 0xcbf29ce484222325u;
  const ElementId end = hierarchy.clusterEnd();
  mix(h, &end, sizeof end);
  for (const Patch& p : scene.patches()) {
    mix(h, &p.area, sizeof p.area);
    mix(h, &p.bounds.low, sizeof p.bounds.low), mix(h, &p.bounds.high, sizeof p.bounds.high);
    mix(h, &p.normal, sizeof p.normal);
    const Vec3 corner = scene.patchPoint(int(&p - scene.patches().data()), {}).position;
    mix(h, &corner, sizeof corner);
  }
  return h;
}

void checkSolutionFile(const std::string& file) {
  const std::ofstream out(partial(file), std::ios::binary);
  if (!out) fail(file, std::string("cannot be written: ") + std::strerror(errno));
  std::remove(partial(file).c_str());
}

void saveSolution(const std::string& file, const SolutionKey& key, const Booking& b,
                  const Hierarchy& hierarchy) {
  std::ofstream out(partial(file), std::ios::binary);
  char line[64];
  std::snprintf(line, sizeof line, "%016llx %a", (unsigned long long)key.surfaces, key.power);
  out << kFirstLine << "\nsurfaces and power " << line << "\nparticles " << b.particles << " of "
      << key.particles << " hits " << b.hits << "\nbooking";
  for (const Flux* f : {&b.emitted, &b.absorbed, &b.escaped, &b.lost, &b.gained})
    for (const std::int64_t x : *f) out << ' ' << x;
  out << "\nelements\n";
  for (ElementId id = 1; id < hierarchy.clusterEnd(); ++id) {
    if (isEmpty(hierarchy.elements()[id])) continue;
    out.write(reinterpret_cast<const char*>(&id), sizeof id);
    writeTree(out, hierarchy, id);
  }
  const ElementId end = 0;
  out.write(reinterpret_cast<const char*>(&end), sizeof end);
  out.close();
  if (!out || std::rename(partial(file).c_str(), file.c_str()) != 0) {
    const std::string why = std::strerror(errno);
    std::remove(partial(file).c_str());
    fail(file, "could not be written: " + why);
  }
}

void addSolution(const std::string& file, SolutionKey& key, Booking& booking,
                 Hierarchy& hierarchy) {
  std::string why;
  std::ifstream in = openRegular(file, why);
  if (!in) fail(file, "cannot be read: it " + why);
  std::string line, word;
  if (!std::getline(in, line) || line != kFirstLine)
    fail(file, "is no radiosity solution of this version");
  SolutionKey own;
  std::string power;
  in >> word >> word >> word >> std::hex >> own.surfaces >> std::dec >> power;
  own.power = std::strtod(power.c_str(), nullptr);
  Booking b;
  in >> word >> b.particles >> word >> own.particles >> word >> b.hits >> word;
  for (Flux* f : {&b.emitted, &b.absorbed, &b.escaped, &b.lost, &b.gained})
    for (std::int64_t& x : *f) in >> x;
  in >> word;
  if (!in || word != "elements" || in.get() != '\n') fail(file, "is damaged");
  if (!(own.power >= 0) || !std::isfinite(own.power) || b.particles > own.particles ||
      own.particles > kMostParticles)
    fail(file, "is damaged");
  if (own.surfaces != key.surfaces)
    fail(file, "was made for other surfaces than this scene has, or with other `clusters`");
  if (key.particles != 0 && (own.particles != key.particles || own.power != key.power))
    fail(file,
         "was made with other lights, or is part of another number of particles, than the "
         "one before it");
  for (;;) {
    ElementId id = 0;
    if (!in.read(reinterpret_cast<char*>(&id), sizeof id) || id >= hierarchy.clusterEnd())
      fail(file, "is damaged");
    if (id == 0) break;
    const int patch = id < hierarchy.firstCluster() ? Hierarchy::patchOf(id) : -1;
    const Cell cell = patch >= 0 ? hierarchy.cellOf(patch) : Cell{};
    if (!readTree(in, hierarchy, id, patch, cell, 0)) fail(file, "is damaged");
  }
  key = own;
  booking.add(b);
}

}  // namespace vestige::particle
