// SPDX-License-Identifier: Apache-2.0
// Lists and texts that copies of a scene description share. A scene with a thousand copies of one
// shape stores its settings once.
#pragma once
#include <initializer_list>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vestige {

/// A list that its copies share until one of them is changed. Read it as a std::vector; change it
/// through edit() or push_back(), which copy the elements first where another list has them too.
/// Any thread may read; only one thread at a time may change a list or its copies.
template <class T>
class SharedList {
 public:
  SharedList() = default;
  SharedList(std::vector<T> items)
      : items_(items.empty() ? nullptr : std::make_shared<std::vector<T>>(std::move(items))) {}
  SharedList(std::initializer_list<T> items) : SharedList(std::vector<T>(items)) {}

  const T* begin() const noexcept { return items_ ? items_->data() : nullptr; }
  const T* end() const noexcept { return begin() + size(); }
  auto rbegin() const noexcept { return std::make_reverse_iterator(end()); }
  auto rend() const noexcept { return std::make_reverse_iterator(begin()); }
  std::size_t size() const noexcept { return items_ ? items_->size() : 0; }
  bool empty() const noexcept { return size() == 0; }
  const T& operator[](std::size_t i) const noexcept { return (*items_)[i]; }
  const T& back() const noexcept { return items_->back(); }

  /// The elements of this list alone, to be changed.
  std::vector<T>& edit() {
    if (!items_)
      items_ = std::make_shared<std::vector<T>>();
    else if (items_.use_count() > 1)
      items_ = std::make_shared<std::vector<T>>(*items_);
    return *items_;
  }
  void push_back(T item) { edit().push_back(std::move(item)); }
  /// Whether both share one list in memory.
  bool sharesWith(const SharedList& other) const noexcept { return items_ == other.items_; }

 private:
  std::shared_ptr<std::vector<T>> items_;
};

/// A text that its copies share. It never changes: another one is assigned.
class SharedText {
 public:
  SharedText() = default;
  SharedText(std::string text)
      : text_(text.empty() ? nullptr : std::make_shared<const std::string>(std::move(text))) {}
  SharedText(std::shared_ptr<const std::string> text) : text_(std::move(text)) {}

  const std::string& str() const noexcept {
    static const std::string none;
    return text_ ? *text_ : none;
  }
  operator const std::string&() const noexcept { return str(); }
  bool empty() const noexcept { return str().empty(); }
  friend bool operator==(const SharedText& a, std::string_view b) noexcept { return a.str() == b; }

 private:
  std::shared_ptr<const std::string> text_;
};

}  // namespace vestige
