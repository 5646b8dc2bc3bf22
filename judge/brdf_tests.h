// SPDX-License-Identifier: Apache-2.0
// Tests of the contract in brdf.h, one function for each promise.
//
// sample(), evaluate().pdf and sampleDerivatives() are three independent statements about one map:
//     sample and pdf           chi-square
//     pdf and derivative       |du.c0 x du.c1| lobePdf = 1
//     sample and derivative    finite differences
// A fault in one of them makes two of these tests fail, which identifies it. evaluate() is tested
// by the weight, by energy and by reciprocity; logGradient() by differences of evaluate().
#pragma once
#include "judge/brdf_event.h"
#include "judge/verdict.h"

namespace vestige::judge {

using BrdfCases = std::vector<BrdfCase>;

// brdf_density.cpp
struct DensityFindings {
  Finding distribution;  ///< samples are distributed as evaluate().pdf: chi-square
  Finding mass;          ///< evaluate().pdf integrates to 1 - P(nullopt or specular)
};
DensityFindings samplesFollowPdf(const BrdfCases& cases, const Effort& effort);
Finding samplesKnowTheirPdf(const BrdfCases& cases, const Effort& effort);
Finding lobesArePartsOfPdf(const BrdfCases& cases, const Effort& effort);

// brdf_value.cpp
Finding weightIsTheQuotient(const BrdfCases& cases, const Effort& effort);
Finding noEnergyIsGained(const BrdfCases& cases, const Effort& effort);
Finding diffusePartIsNoMoreThanThereIs(const BrdfCases& cases, const Effort& effort);
/// f(b, a) = etaScale(a, b) f(a, b): on one side of the surface, or through it.
Finding isReciprocal(const BrdfCases& cases, const Effort& effort, bool across);
Finding etaScaleFollowsSnell(const BrdfCases& cases, const Effort& effort);

// brdf_derivatives.cpp
Finding areaIsInverseDensity(const BrdfCases& cases, const Effort& effort);
Finding duIsTheDerivative(const BrdfCases& cases, const Effort& effort);
Finding dPrevIsTheDerivative(const BrdfCases& cases, const Effort& effort);
Finding logGradientIsTheDerivative(const BrdfCases& cases, const Effort& effort);

// brdf_fuzz.cpp
/// No NaN, infinity or negative density. `schema`: inputs that a texture may drive out of their
/// range; null: none.
Finding nothingIsNan(const BrdfCases& cases, const Schema* schema, int events, unsigned seed);

// brdf_threads.cpp
Finding answersStayTheSame(const BrdfCases& cases, const Effort& effort);
std::vector<Timing> timings(const BrdfCases& cases);

}  // namespace vestige::judge
