// SPDX-License-Identifier: Apache-2.0
// Patches that a wide footprint may take as one: those that lie close together, in nearly one
// plane, and look the same way. A constant irradiance on anything else would light what lies behind
// it.
#pragma once
#include <cstdint>
#include <vector>

#include <vestige/math.h>

namespace vestige::particle {

/// One side of a patch.
struct ClusterMember {
  Vec3 centre, normal;  ///< normal: unit, out of that side
  Bounds bounds;
  double area;
  std::uint32_t root;
};

struct Cluster {
  double area;           ///< of the members
  std::uint32_t parent;  ///< a cluster's index + 1; 0: none
};

struct Clusters {
  std::vector<Cluster> list;
  std::vector<std::uint32_t> above;  ///< by member: its smallest cluster's index + 1; 0: none
};

/// Members are reordered; `above` follows their order afterwards.
Clusters makeClusters(std::vector<ClusterMember>& members);

}  // namespace vestige::particle
