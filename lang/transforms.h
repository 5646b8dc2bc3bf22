// SPDX-License-Identifier: Apache-2.0
// The matrices of translate, rotate, scale and matrix, as POV-Ray's: angles in degrees.
#pragma once
#include "lang/value.h"

namespace vestige::lang {

Affine translation(const Numbers& by);
/// A factor of 0 counts as 1, POV-Ray's rule (the caller warns).
Affine scaling(const Numbers& by);
/// About x, then about y, then about z; +90 about z takes x to y.
Affine rotation(const Numbers& degrees);
/// Rodrigues' formula; the axis needs a length.
Affine rotationAround(const Numbers& axis, double degrees);
/// Four row vectors: q = p * M + last row.
Affine fromRows(const double (&rows)[12]);

}  // namespace vestige::lang
