// SPDX-License-Identifier: Apache-2.0
// The point that a scene is traced around: float keeps 7 digits, so a room of 5 units that stands
// 50,000 units from the origin would be left with 3 of them.
#pragma once
#include <vestige/shape.h>

namespace vestige {

/// Where the origin of the traced space stands, for a scene of this extent: zero where the extent
/// is empty or stands around the origin, else a point of a coarse grid near its centre. The grid
/// goes by the size of the extent in powers of two, so most small changes of a scene keep the
/// point.
Vec3 middleOf(const Bounds& extent) noexcept;

/// World bounds of a shape, mesh or not; infinite for a plane, empty for a mesh without corners.
Bounds boundsIn(const Shape& shape, const Affine& toWorld) noexcept;

/// The same transform into the space around `middle`. Bit for bit the same for a middle of zero.
Affine around(Vec3 middle, const Affine& toWorld) noexcept;

}  // namespace vestige
