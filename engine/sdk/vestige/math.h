// SPDX-License-Identifier: Apache-2.0
// Numbers, vectors, colours and frames.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <vestige/medium_stack.h>

namespace vestige {

#ifdef VESTIGE_DOUBLE
using Real = double;  ///< preset `double`: tight tests of derivatives
#else
using Real = float;
#endif

inline constexpr Real kPi = Real(3.14159265358979323846L);
inline constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
inline constexpr Real kOneMinusEpsilon = 1 - std::numeric_limits<Real>::epsilon() / 2;

inline constexpr Real radians(Real degrees) noexcept { return degrees * (kPi / 180); }
inline constexpr Real sqr(Real x) noexcept { return x * x; }
/// sqrt that takes small negative values (from rounding) as zero.
inline Real safeSqrt(Real x) noexcept { return std::sqrt(std::max(Real(0), x)); }

/// Four numbers side by side: one register.
typedef Real Four __attribute__((vector_size(4 * sizeof(Real))));

// ---------------------------------------------------------------- vectors
struct Vec2 {
  Real x{}, y{};
};
inline constexpr Vec2 operator+(Vec2 a, Vec2 b) noexcept { return {a.x + b.x, a.y + b.y}; }
inline constexpr Vec2 operator-(Vec2 a, Vec2 b) noexcept { return {a.x - b.x, a.y - b.y}; }
inline constexpr Vec2 operator*(Real s, Vec2 a) noexcept { return {s * a.x, s * a.y}; }
inline constexpr Vec2 operator*(Vec2 a, Real s) noexcept { return s * a; }
inline constexpr bool operator==(Vec2 a, Vec2 b) noexcept { return a.x == b.x && a.y == b.y; }
inline constexpr Real dot(Vec2 a, Vec2 b) noexcept { return a.x * b.x + a.y * b.y; }
inline constexpr Real cross(Vec2 a, Vec2 b) noexcept { return a.x * b.y - a.y * b.x; }

struct Vec3 {
  Real x{}, y{}, z{};
  constexpr Real operator[](int i) const noexcept { return i == 0 ? x : i == 1 ? y : z; }
  constexpr Real& operator[](int i) noexcept { return i == 0 ? x : i == 1 ? y : z; }
};
inline constexpr Vec3 operator+(Vec3 a, Vec3 b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline constexpr Vec3 operator-(Vec3 a, Vec3 b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline constexpr Vec3 operator-(Vec3 a) noexcept { return {-a.x, -a.y, -a.z}; }
inline constexpr Vec3 operator*(Real s, Vec3 a) noexcept { return {s * a.x, s * a.y, s * a.z}; }
inline constexpr Vec3 operator*(Vec3 a, Real s) noexcept { return s * a; }
inline constexpr Vec3 operator/(Vec3 a, Real s) noexcept { return a * (1 / s); }
inline constexpr Vec3& operator+=(Vec3& a, Vec3 b) noexcept { return a = a + b; }
inline constexpr Vec3& operator-=(Vec3& a, Vec3 b) noexcept { return a = a - b; }
inline constexpr Vec3& operator*=(Vec3& a, Real s) noexcept { return a = a * s; }
inline constexpr bool operator==(Vec3 a, Vec3 b) noexcept {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
inline constexpr Real dot(Vec3 a, Vec3 b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline constexpr Vec3 cross(Vec3 a, Vec3 b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline constexpr Real lengthSquared(Vec3 a) noexcept { return dot(a, a); }
inline Real length(Vec3 a) noexcept { return std::sqrt(dot(a, a)); }
/// Unit vector along a; a itself where it has no length.
inline Vec3 normalize(Vec3 a) noexcept {
  const Real l = length(a);
  return l > 0 ? a / l : a;
}
inline constexpr Vec3 multiply(Vec3 a, Vec3 b) noexcept {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline Vec3 minimum(Vec3 a, Vec3 b) noexcept {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
inline Vec3 maximum(Vec3 a, Vec3 b) noexcept {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
inline Real maxAbsComponent(Vec3 a) noexcept {
  return std::max(std::abs(a.x), std::max(std::abs(a.y), std::abs(a.z)));
}
inline bool isFinite(Vec3 a) noexcept { return std::isfinite(a.x + a.y + a.z); }

// ---------------------------------------------------------------- colours
/// A linear colour in rendering space (Rec. 709).
struct Rgb {
  Real r{}, g{}, b{};
};
inline constexpr Rgb operator+(Rgb a, Rgb b) noexcept { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
inline constexpr Rgb operator-(Rgb a, Rgb b) noexcept { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
inline constexpr Rgb operator*(Rgb a, Rgb b) noexcept { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
inline constexpr Rgb operator*(Real s, Rgb a) noexcept { return {s * a.r, s * a.g, s * a.b}; }
inline constexpr Rgb operator*(Rgb a, Real s) noexcept { return s * a; }
inline constexpr Rgb operator/(Rgb a, Real s) noexcept { return a * (1 / s); }
inline constexpr Rgb& operator+=(Rgb& a, Rgb b) noexcept { return a = a + b; }
inline constexpr Rgb& operator*=(Rgb& a, Rgb b) noexcept { return a = a * b; }
inline constexpr bool operator==(Rgb a, Rgb b) noexcept {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}
inline constexpr Rgb grey(Real v) noexcept { return {v, v, v}; }
/// Rec. 709 weights [ITU-R BT.709-6].
inline constexpr Real luminance(Rgb c) noexcept {
  return Real(0.2126) * c.r + Real(0.7152) * c.g + Real(0.0722) * c.b;
}
inline Real maxComponent(Rgb c) noexcept { return std::max(c.r, std::max(c.g, c.b)); }
inline bool isBlack(Rgb c) noexcept { return c.r == 0 && c.g == 0 && c.b == 0; }
inline bool isFinite(Rgb c) noexcept { return std::isfinite(c.r + c.g + c.b); }

/// A colour with coverage: alpha 1 hides the background. Not premultiplied.
struct Rgba {
  Rgb colour;
  Real alpha = 1;
};

// ---------------------------------------------------------------- matrices, by columns
struct Mat3 {
  Vec3 c[3];
};
/// Two columns: the derivatives of a vector by two variables.
struct Mat3x2 {
  Vec3 c[2];
};
inline constexpr Vec3 operator*(const Mat3& m, Vec3 v) noexcept {
  return v.x * m.c[0] + v.y * m.c[1] + v.z * m.c[2];
}
inline constexpr Vec3 operator*(const Mat3x2& m, Vec2 v) noexcept {
  return v.x * m.c[0] + v.y * m.c[1];
}
inline constexpr Mat3 operator*(const Mat3& a, const Mat3& b) noexcept {
  return {a * b.c[0], a * b.c[1], a * b.c[2]};
}
inline constexpr Mat3x2 operator*(const Mat3& a, const Mat3x2& b) noexcept {
  return {a * b.c[0], a * b.c[1]};
}
inline constexpr Mat3 operator*(Real s, const Mat3& m) noexcept {
  return {s * m.c[0], s * m.c[1], s * m.c[2]};
}
inline constexpr Mat3x2 operator*(Real s, const Mat3x2& m) noexcept {
  return {s * m.c[0], s * m.c[1]};
}
inline constexpr Mat3 operator+(const Mat3& a, const Mat3& b) noexcept {
  return {a.c[0] + b.c[0], a.c[1] + b.c[1], a.c[2] + b.c[2]};
}
inline constexpr Mat3 operator-(const Mat3& a, const Mat3& b) noexcept {
  return {a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]};
}
inline constexpr Mat3 diagonal(Real x, Real y, Real z) noexcept {
  return {Vec3{x, 0, 0}, Vec3{0, y, 0}, Vec3{0, 0, z}};
}
inline constexpr Mat3 identity() noexcept { return diagonal(1, 1, 1); }
/// a b^T
inline constexpr Mat3 outer(Vec3 a, Vec3 b) noexcept { return {b.x * a, b.y * a, b.z * a}; }
/// [v]x: takes a to v x a.
inline constexpr Mat3 crossMatrix(Vec3 v) noexcept {
  return {Vec3{0, v.z, -v.y}, Vec3{-v.z, 0, v.x}, Vec3{v.y, -v.x, 0}};
}
inline constexpr Mat3 transpose(const Mat3& m) noexcept {
  return {Vec3{m.c[0].x, m.c[1].x, m.c[2].x}, Vec3{m.c[0].y, m.c[1].y, m.c[2].y},
          Vec3{m.c[0].z, m.c[1].z, m.c[2].z}};
}
inline constexpr Real determinant(const Mat3& m) noexcept {
  return dot(m.c[0], cross(m.c[1], m.c[2]));
}
/// Cofactor matrix: takes normals along when m takes points along; inverse^T times determinant.
inline constexpr Mat3 cofactor(const Mat3& m) noexcept {
  return {cross(m.c[1], m.c[2]), cross(m.c[2], m.c[0]), cross(m.c[0], m.c[1])};
}
/// Inverse; every entry infinite or NaN where the determinant is zero.
inline constexpr Mat3 inverse(const Mat3& m) noexcept {
  return (1 / determinant(m)) * transpose(cofactor(m));
}
/// I - v v^T for unit v: the projection onto the plane perpendicular to v.
inline constexpr Mat3 projection(Vec3 v) noexcept { return identity() - outer(v, v); }

/// Orthonormal axes; n is the normal or the axis.
struct Frame {
  Vec3 s, t, n;

  /// Some s and t for a unit n, without branch or pole [Duff et al. 2017, JCGT 6(1)].
  static Frame around(Vec3 n) noexcept {
    const Real sign = std::copysign(Real(1), n.z);
    const Real a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }
  /// The frame around unit n whose s lies nearest to `along`; around(n) if `along` is parallel to n
  /// or zero.
  static Frame along(Vec3 n, Vec3 along) noexcept {
    const Vec3 across = along - dot(along, n) * n;
    const Real l2 = lengthSquared(across);
    if (!(l2 > Real(1e-12) * lengthSquared(along)) || !(l2 > 0)) return around(n);
    const Vec3 s = across / std::sqrt(l2);
    return {s, cross(n, s), n};
  }
  Vec3 toWorld(Vec3 v) const noexcept { return v.x * s + v.y * t + v.z * n; }
  Vec3 toLocal(Vec3 v) const noexcept { return {dot(v, s), dot(v, t), dot(v, n)}; }
};

// ---------------------------------------------------------------- space
/// p -> linear p + offset. Kept in double: scenes are composed of many of them.
struct Affine {
  double m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};  ///< rows; last column is the offset

  Vec3 point(Vec3 p) const noexcept { return apply(p, 1); }
  Vec3 vector(Vec3 v) const noexcept { return apply(v, 0); }
  Mat3 linear() const noexcept {
    Mat3 l;
    for (int j = 0; j < 3; ++j) l.c[j] = {Real(m[0][j]), Real(m[1][j]), Real(m[2][j])};
    return l;
  }
  double determinant() const noexcept {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }
  /// The inverse; requires determinant() != 0.
  Affine inverse() const noexcept {
    Affine r;
    const double d = 1 / determinant();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, e = (i + 2) % 3;
        r.m[i][j] = d * (m[a][c] * m[b][e] - m[a][e] * m[b][c]);
      }
    for (int i = 0; i < 3; ++i)
      r.m[i][3] = -(r.m[i][0] * m[0][3] + r.m[i][1] * m[1][3] + r.m[i][2] * m[2][3]);
    return r;
  }
  bool isIdentity() const noexcept {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j)
        if (m[i][j] != (i == j ? 1 : 0)) return false;
    return true;
  }

 private:
  Vec3 apply(Vec3 p, double w) const noexcept {
    const auto row = [&](int i) {
      return Real(m[i][0] * p.x + m[i][1] * p.y + m[i][2] * p.z + m[i][3] * w);
    };
    return {row(0), row(1), row(2)};
  }
};
/// First b, then a.
inline Affine operator*(const Affine& a, const Affine& b) noexcept {
  Affine r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) {
      r.m[i][j] = j == 3 ? a.m[i][3] : 0;
      for (int k = 0; k < 3; ++k) r.m[i][j] += a.m[i][k] * b.m[k][j];
    }
  return r;
}

struct Bounds {
  Vec3 low{kInfinity, kInfinity, kInfinity};
  Vec3 high{-kInfinity, -kInfinity, -kInfinity};  ///< low > high: empty

  bool isEmpty() const noexcept { return !(low.x <= high.x); }
  bool isInfinite() const noexcept { return !isEmpty() && !isFinite(high - low); }
  bool contains(Vec3 p) const noexcept {
    return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z &&
           p.z <= high.z;
  }
  /// Whether the two share a point.
  bool meets(const Bounds& b) const noexcept {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y &&
           low.z <= b.high.z && b.low.z <= high.z;
  }
  Vec3 centre() const noexcept { return Real(0.5) * (low + high); }
  Vec3 size() const noexcept { return high - low; }
  void add(Vec3 p) noexcept { low = minimum(low, p), high = maximum(high, p); }
  void add(const Bounds& b) noexcept { low = minimum(low, b.low), high = maximum(high, b.high); }
};

/// The purpose of a ray. An object is visible to a set of kinds, a sum of these values.
enum class RayKind : std::uint8_t {
  camera = 1,
  shadow = 2,      ///< from a surface towards a light
  reflection = 4,  ///< from a mirror: light sampling does not compete with it
  refraction = 8,  ///< through smooth glass, likewise
  indirect = 16,   ///< any other scattered ray; particles too
  any = 31,        ///< as the kind of a ray: meets what is visible to any kind
};
inline constexpr unsigned bits(RayKind k) noexcept { return unsigned(k); }
inline constexpr RayKind operator|(RayKind a, RayKind b) noexcept {
  return RayKind(bits(a) | bits(b));
}
inline constexpr RayKind operator&(RayKind a, RayKind b) noexcept {
  return RayKind(bits(a) & bits(b));
}
/// Whether two sets share a kind.
inline constexpr bool shareKind(RayKind a, RayKind b) noexcept { return bits(a & b) != 0; }
/// The kinds of `a` that are not in `b`.
inline constexpr RayKind without(RayKind a, RayKind b) noexcept {
  return RayKind(bits(a) & ~bits(b));
}

struct Ray {
  Vec3 origin;
  Vec3 direction;  ///< not always unit in a shape's own space
  Real tMin = 0, tMax = kInfinity;
  Real time = 0;  ///< [0,1), share of the shutter's opening that has passed
  RayKind kind = RayKind::any;
  MediumStack media{};  ///< around the origin
  Vec3 at(Real t) const noexcept { return origin + t * direction; }
};

// ---------------------------------------------------------------- four vectors at once
struct Four3 {
  Four x, y, z;
};
inline Four four(Real v) noexcept { return Four{v, v, v, v}; }
inline Four3 columns(Vec3 a, Vec3 b, Vec3 c, Vec3 d) noexcept {
  return {Four{a.x, b.x, c.x, d.x}, Four{a.y, b.y, c.y, d.y}, Four{a.z, b.z, c.z, d.z}};
}
inline Vec3 column(const Four3& a, int i) noexcept { return {a.x[i], a.y[i], a.z[i]}; }
inline Four3 operator+(const Four3& a, const Four3& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Four3 operator*(Real s, const Four3& a) noexcept { return {s * a.x, s * a.y, s * a.z}; }
inline Four3 operator*(const Mat3& m, const Four3& v) noexcept {
  return {m.c[0].x * v.x + m.c[1].x * v.y + m.c[2].x * v.z,
          m.c[0].y * v.x + m.c[1].y * v.y + m.c[2].y * v.z,
          m.c[0].z * v.x + m.c[1].z * v.y + m.c[2].z * v.z};
}
inline Four dot(Vec3 a, const Four3& b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Four3 cross(Vec3 a, const Four3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Four3 cross(const Four3& a, Vec3 b) noexcept { return Real(-1) * cross(b, a); }

/// Derivatives of a ray's origin and direction by the random numbers that it was drawn with [PD01
/// Sec. 2.3]. Cameras: numbers 0, 1 are the film's, 2, 3 the lens's. Emission: 0, 1 choose the
/// point, 2, 3 the direction.
struct RayJacobian {
  std::array<Vec3, 4> dOrigin{}, dDirection{};
};

}  // namespace vestige
