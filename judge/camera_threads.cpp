// SPDX-License-Identifier: Apache-2.0
// Repeated calls of a camera, in another order and from many threads at once; and the time of a
// call.
#include "judge/camera_tests.h"
#include "judge/same_answers.h"
#include "judge/timing.h"

namespace vestige::judge {
namespace {

const char* const kMethods[] = {"sample()", "pdf()", "sampleDerivatives()"};

struct Question {
  const CameraCase* camera;
  CameraNumbers numbers;
  CameraSample ray;
};

Bits answer(const Question& q, std::size_t method) {
  const Camera& camera = *q.camera->camera;
  Bits bits;
  if (method == 0) {
    if (const auto s = camera.sample(q.numbers))
      bits.add(s->origin), bits.add(s->direction), bits.add(s->weight);
  } else if (method == 1) {
    bits.add(camera.pdf(q.ray.origin, q.ray.direction, q.numbers.aspect));
  } else {
    const RayJacobian j = camera.sampleDerivatives(q.numbers);
    for (int k = 0; k < 4; ++k) bits.add(j.dOrigin[k]), bits.add(j.dDirection[k]);
  }
  return bits;
}

std::vector<Question> questions(const CameraCases& cases, int samples, unsigned seed) {
  std::vector<Question> list;
  forCameraEvents(cases, {.samples = std::max(samples, 256), .seed = seed},
                  [&](const CameraCase& c, CameraNumbers n, Random&) {
                    if (const auto s = c.camera->sample(n)) list.push_back({&c, n, *s});
                  });
  return list;
}

}  // namespace

Finding cameraAnswersStayTheSame(const CameraCases& cases, const Effort& effort) {
  const std::vector<Question> list = questions(cases, effort.samples / 8, effort.seed);
  const auto ask = [&](std::size_t i, std::size_t method) { return answer(list[i], method); };
  return sameAnswers(list.size(), kMethods, ask, [&](std::size_t i, const std::string& what) {
    return cameraEvent(*list[i].camera, list[i].numbers, what);
  });
}

std::vector<Timing> cameraTimings(const CameraCases& cases) {
  const std::vector<Question> list = questions(cases, 1600, 1);
  const auto taken = [&](const char* method, const auto& call) {
    return Timing{method,
                  nanoseconds(list, [&](const Question& q) { return call(*q.camera->camera, q); })};
  };
  using Q = const Question&;
  return {
      taken("sample()",
            [](const Camera& c, Q q) {
              const auto s = c.sample(q.numbers);
              return s ? s->direction.x : 0;
            }),
      taken("pdf()", [](const Camera& c,
                        Q q) { return c.pdf(q.ray.origin, q.ray.direction, q.numbers.aspect); }),
      taken("sampleDerivatives()",
            [](const Camera& c, Q q) { return c.sampleDerivatives(q.numbers).dDirection[0].x; })};
}

}  // namespace vestige::judge
