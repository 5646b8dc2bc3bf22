// SPDX-License-Identifier: Apache-2.0
// From a description to a scene: creates plugins, places shapes, wires materials and lights. Used
// by buildScene() and its two sisters only.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/scene/build_cache.h"
#include "engine/scene/scene_host.h"
#include "engine/scene/scene_impl.h"

namespace vestige {

/// The values of a schema's params for a block: given or default, numbers promoted to the row's
/// type.
std::vector<Value> valuesFor(const std::vector<Parameter>& rows, const Block& block);
/// One value as an evaluated input of the row's type.
InputValue constantInput(const Parameter& row, const Value& value);

/// The material of a shape that names none: a diffuse grey.
inline Block defaultBrdf() {
  Block b;
  b.kind = "brdf";
  b.plugin = "lambert";
  return b;
}

class SceneBuilder {
 public:
  SceneBuilder(Scene& scene, const SceneDesc& description, const Registry& registry,
               const BuildOptions& options, Diagnostics& diagnostics);
  /// Fills an empty scene; false after an error. The other two replace one part of a full one.
  bool build();
  bool renewCamera();
  bool renewIntegrator();

 private:
  template <class Interface>
  std::shared_ptr<Interface> create(const Block& block);
  bool known(const Block& block);

  /// Creates the shapes of a block, which addShape() then places: where the scene stands must be
  /// known before anything is placed.
  void prepareShapes(const Block& block);
  void report(const Diagnostics& held);
  Vec3 findMiddle();
  template <class Interface>
  std::shared_ptr<Interface> tryOut(const Block& block) const;
  /// A transform to world space, into the space that is traced in.
  Affine traced(const Affine& toWorld) const;
  void addTop(const Block& block);
  /// `outer...`: what the unions around it say.
  void addShape(const Block& block, const Block* outerBrdf, RayKind outerKinds);
  void addMeshParts(const Block& block, const std::shared_ptr<const Shape>& shape,
                    const Block* brdf, RayKind visibleTo);
  /// The kinds of rays that meet a block; `outer`: where it does not say.
  RayKind visibility(const Block& block, RayKind outer);
  /// Shares one shape among blocks that say the same, in this build and the one before.
  std::shared_ptr<const Shape> shapeFor(const Block& block);
  const BuildCache::KeptShape& takeShape(const BuildCache::KeptShape& kept, const Block& block);
  BuildCache::KeptShape makeShape(const Block& block);
  /// Tells the user where the rows of a solid do nothing.
  void warnOfSolids();
  /// Leaves the cache what this build used, and nothing else.
  void fillCache();
  /// Object of a placement that wears a brdf block (null: default lambert); -1 after an error.
  int addObject(const Block* brdf, const Affine& partToWorld);
  void place(Placement placement, const Block* brdf, const Value* emission, bool bothSides,
             const Block& shapeBlock);
  void addEmission(Placement& placement, const Value& emission, bool bothSides,
                   const Block& shapeBlock);
  void addLight(const Block& block);
  void addCamera();
  void addIntegrator();
  void readFilm(const Block& block);
  std::optional<PlacedPigment> pigment(const Block& block, const Affine& outer);
  Material materialFor(const Block& block, const Affine& partToWorld);
  /// The inputs that a BRDF and those inside it declare; `isNested`: without the engine's own.
  void addInputs(const Block& block, bool isNested);
  void chooseIndex(Material& m, int index);
  void evaluateInput(Material& m, int index, const Affine& partToWorld);
  NestedBrdf nestedBrdf(const Block* block);
  std::shared_ptr<const Pigment> nestedPigment(const Block& block);
  std::shared_ptr<const Medium> nestedMedium(const Block& block);
  std::shared_ptr<const PhaseFunction> nestedPhase(const Block& block);
  bool isInvertible(const Affine& transform, Span place);
  /// A block's span, or that of the shape whose file brought the block along.
  Span at(Span span) const { return span.file >= 0 ? span : place_; }
  Diagnostic& error(Span span, std::string message);

  const SceneDesc& description_;
  const Registry& registry_;
  const BuildOptions& options_;
  Diagnostics& diagnostics_;
  Scene::Impl& impl_;
  SceneHost host_;
  Span place_;  ///< of the shape being placed
  struct InputRow {
    const Parameter* row;
    const Value* given;  ///< null: the default
  };
  std::vector<InputRow> inputs_;  ///< of the material being made
  int firstInput_ = -1;           ///< of the BRDF being created; -1: no material is being made
  std::map<std::string, BuildCache::KeptShape> shapes_;
  struct Prepared {
    std::shared_ptr<const Shape> shape;  ///< null: refused
    Diagnostics said;                    ///< while it was created
  };
  std::map<const Block*, Prepared> prepared_;
  BuildCache::Use use_;
};

}  // namespace vestige
