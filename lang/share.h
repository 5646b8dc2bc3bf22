// SPDX-License-Identifier: Apache-2.0
// Counts of what is alive: bytes, elements of arrays.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

namespace vestige::lang {

/// A count of live objects. A scene returns its shares when it is destroyed, on any thread.
using Total = std::shared_ptr<std::atomic<std::int64_t>>;

/// A share of a total, returned when its owner is destroyed.
class Share {
 public:
  Share() = default;
  Share(Total total, std::int64_t size) : total_(std::move(total)), size_(size) {
    *total_ += size_;
  }
  Share(const Share& other) : total_(other.total_), size_(other.size_) {
    if (total_) *total_ += size_;
  }
  Share(Share&& other) noexcept : total_(std::move(other.total_)), size_(other.size_) {}
  Share& operator=(Share other) noexcept {
    std::swap(total_, other.total_);
    std::swap(size_, other.size_);
    return *this;
  }
  /// Whether it counts nothing yet.
  bool isEmpty() const { return !total_; }
  void grow(std::int64_t size) {
    if (total_) *total_ += size;
    size_ += size;
  }
  ~Share() {
    if (total_) *total_ -= size_;
  }

 private:
  Total total_;
  std::int64_t size_ = 0;
};

}  // namespace vestige::lang
