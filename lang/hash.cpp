// SPDX-License-Identifier: Apache-2.0
// FNV-1a, 64 bits [Fowler, Noll, Vo].
#include "lang/hash.h"

#include <cstring>
#include <unordered_map>

namespace vestige::lang {
namespace {

class Hash {
 public:
  void add(std::uint64_t bits) {
    for (int i = 0; i < 8; ++i) byte(static_cast<unsigned char>(bits >> (8 * i)));
  }
  void add(double x) {
    if (x == 0) x = 0;  // -0 means the same
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    add(bits);
  }
  void add(const std::string& s) {
    add(std::uint64_t(s.size()));
    for (const char c : s) byte(static_cast<unsigned char>(c));
  }
  void add(const Affine& a) {
    for (const auto& row : a.m)
      for (const double x : row) add(x);
  }
  void add(const Value& v) {
    add(std::uint64_t(v.kind));
    add(std::uint64_t(v.size));
    for (const double x : v.v) add(x);
    add(shared(v.text.str(), v.text.str().size()));
    if (v.block) add(*v.block);
    if (v.list) add(shared(*v.list, v.list->entries.size()));
    if (v.function) add(v.function->fingerprint());
  }
  void add(const List& list) {
    add(std::uint64_t(list.entries.size()));
    for (const Entry& e : list.entries) {
      add(e.key);
      add(e.value);
    }
  }
  void add(const Block& b) {
    add(b.kind);
    add(b.plugin);
    add(b.own);
    add(b.world);
    add(std::uint64_t(b.settings.size()));
    for (const Setting& s : b.settings) {
      add(s.name);
      add(s.value);
    }
    add(std::uint64_t(b.children.size()));
    for (const Block& child : b.children) add(child);
  }
  std::uint64_t value() const { return value_; }

 private:
  /// The hash of a value that many blocks may share, computed once if it is expensive.
  template <class T>
  std::uint64_t shared(const T& item, std::size_t size) {
    constexpr std::size_t kLong = 32;
    const auto known = known_.find(&item);
    if (known != known_.end()) return known->second;
    Hash own;
    own.known_.swap(known_);  // what the item shares with others is computed once, too
    own.add(item);
    own.known_.swap(known_);
    if (size >= kLong) known_[&item] = own.value();
    return own.value();
  }
  void byte(unsigned char b) {
    value_ ^= b;
    value_ *= 0x100000001b3ull;
  }
  std::uint64_t value_ = 0xcbf29ce484222325ull;
  std::unordered_map<const void*, std::uint64_t> known_;
};

}  // namespace

std::uint64_t hashOf(const SceneDesc& scene) {
  Hash hash;
  for (const Block& b : scene.blocks) hash.add(b);
  return hash.value();
}

}  // namespace vestige::lang
