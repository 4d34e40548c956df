#include "mechanics/step_report.hpp"

#include "base/text.hpp"

namespace strut {

std::string place_text(const Vector& place) { return text_of("(", place[0], ", ", place[1], ", ", place[2], ") m"); }

std::string locate(const Body& body, int i) {
  if (i < 0) return "";
  const PointCloud& cloud = body.domain.cloud;
  return text_of(word(cloud.at), " ", cloud.element_ids[i], " of block ", cloud.block_names[cloud.blocks[i]],
                 ", reference position ", place_text(body.domain.reference(i)), ", now at ",
                 place_text(body.current(i)));
}

namespace {

std::string why_no_stress(const MaterialBlock& block) {
  const auto of_law = [](const auto& law) -> std::string {
    if constexpr (requires { law.why_no_stress(); }) {
      return law.why_no_stress();
    } else {
      return "the material law found no stress. Likely causes: a strain increment that is not finite or far too large "
             "for one step, material constants of the wrong unit";
    }
  };
  return std::visit(of_law, block.material.law);
}

}  // namespace

std::string describe(const Failure& failure, const Body& body) {
  const std::string why =
      failure.kind == Failure::Kind::no_stress ? why_no_stress(body.block_of(failure.point))
      : failure.kind == Failure::Kind::inverted
          ? "the deformation gradient has no positive determinant (the point is turned inside out). Likely causes: a "
            "step above the stable one, too little stabilization, a load too sudden"
          : "its strain is not a number (places are not, or two points met). Likely causes: a step above the stable "
            "one, a load too sudden, an expression without a value";
  return locate(body, failure.point) + ": " + why;
}

}  // namespace strut
