// SPDX-License-Identifier: Apache-2.0
// A vector indexed by int, for tables of objects, lights and patches.
#pragma once
#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

namespace vestige {

/// At most 2^31 - 1 entries. An index outside [0, size()) violates the contract: an assert.
template <class T>
class Table {
 public:
  using value_type = T;
  using reference = typename std::vector<T>::reference;
  using const_reference = typename std::vector<T>::const_reference;

  Table() = default;
  explicit Table(int size, const T& value = T()) : items_(std::size_t(size), value) {}
  Table(std::initializer_list<T> items) : items_(items) {}
  explicit Table(std::vector<T> items) noexcept : items_(std::move(items)) {
    assert(items_.size() <= std::size_t(std::numeric_limits<int>::max()));
  }

  reference operator[](int i) noexcept { return items_[checked(i)]; }
  const_reference operator[](int i) const noexcept { return items_[checked(i)]; }
  reference back() noexcept { return items_[checked(size() - 1)]; }
  const_reference back() const noexcept { return items_[checked(size() - 1)]; }

  int size() const noexcept { return int(items_.size()); }
  bool empty() const noexcept { return items_.empty(); }
  T* data() noexcept { return items_.data(); }
  const T* data() const noexcept { return items_.data(); }
  auto begin() noexcept { return items_.begin(); }
  auto begin() const noexcept { return items_.begin(); }
  auto end() noexcept { return items_.end(); }
  auto end() const noexcept { return items_.end(); }

  void push_back(T item) { items_.push_back(std::move(item)); }
  void resize(int size, const T& value = T()) { items_.resize(std::size_t(size), value); }
  void reserve(int size) { items_.reserve(std::size_t(size)); }
  void clear() noexcept { items_.clear(); }

  bool operator==(const Table&) const = default;

 private:
  std::size_t checked(int i) const noexcept {
    assert(i >= 0 && i < size());
    return std::size_t(i);
  }

  std::vector<T> items_;
};

}  // namespace vestige
