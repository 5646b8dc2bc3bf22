// SPDX-License-Identifier: Apache-2.0
// The values that expressions have at parse time.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <vestige/scene_desc.h>

#include "lang/share.h"

namespace vestige::lang {

/// A number (size 1), a vector (2 to 5) or a colour (5: red green blue filter transmit).
struct Numbers {
  int size = 1;
  bool isColour = false;
  std::array<double, 5> v{};

  Numbers() = default;
  explicit Numbers(double x) : v{x, 0, 0, 0, 0} {}
  Numbers(double x, double y, double z) : size(3), v{x, y, z, 0, 0} {}
  /// Component i as an operand of a vector that long: a number fills all, a short vector is filled
  /// with zeros.
  double at(int i) const { return size == 1 ? v[0] : i < size ? v[std::size_t(i)] : 0; }
};

struct Macro;     // symbols.h
struct Function;  // ast.h
struct Array;
struct Spline;      // spline.h
struct DataFile;    // data_file.h
struct Dictionary;  // dictionary.h

using TextPtr = std::shared_ptr<const std::string>;
using BlockPtr = std::shared_ptr<const Block>;
using AffinePtr = std::shared_ptr<const Affine>;
using MacroPtr = std::shared_ptr<const Macro>;
using FunctionPtr = std::shared_ptr<const Function>;
using ArrayPtr = std::shared_ptr<const Array>;
using SplinePtr = std::shared_ptr<const Spline>;
using DataFilePtr = std::shared_ptr<DataFile>;
using DictionaryPtr = std::shared_ptr<const Dictionary>;

/// std::monostate: the value of an expression whose error has already been reported; later steps
/// accept it silently.
using Datum = std::variant<std::monostate, Numbers, TextPtr, BlockPtr, AffinePtr, FunctionPtr,
                           ArrayPtr, MacroPtr, SplinePtr, DataFilePtr, DictionaryPtr>;

/// Flat, the last index fastest.
struct Array {
  std::vector<int> sizes;
  std::vector<Datum> data;  ///< monostate: not yet assigned
  Share share = {};         ///< share of the limit on live elements
  Share bytes = {};
};

inline Datum textDatum(std::string s) { return std::make_shared<const std::string>(std::move(s)); }
inline const Numbers* numbers(const Datum& d) { return std::get_if<Numbers>(&d); }
inline bool isBroken(const Datum& d) { return std::holds_alternative<std::monostate>(d); }

/// Numbers up to this size are false, and numbers that differ by no more are equal; POV-Ray's
/// EPSILON.
inline constexpr double kTruth = 1e-10;
inline bool isTrue(double x) { return !(x <= kTruth && x >= -kTruth); }

/// "the number 3", "the vector <1, 2, 3>", "a string", "a brdf": a value in messages.
std::string describe(const Datum& datum);
/// Shortest text that reads back the same: "0.1", "1e+30".
std::string shortest(double x);

}  // namespace vestige::lang
