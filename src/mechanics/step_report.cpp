#include "mechanics/step_report.hpp"

#include <sstream>

namespace strut {

std::string locate(const Body& body, int i) {
  const PointCloud& cloud = body.domain.cloud;
  const auto place = [](const Vector& x) {
    std::ostringstream text;
    text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
    return text.str();
  };
  std::ostringstream text;
  text << word(cloud.at) << " " << cloud.element_ids[i] << " of block " << cloud.block_names[cloud.blocks[i]]
       << ", reference position " << place(body.domain.reference(i)) << " m, now at " << place(body.current(i)) << " m";
  return text.str();
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
  std::ostringstream text;
  text << locate(body, failure.point) << ": ";
  switch (failure.kind) {
    case Failure::Kind::inverted:
      text << "the deformation gradient has no positive determinant (the point is turned inside out). Likely causes: a "
              "step above the stable one, too little stabilization, a load too sudden";
      break;
    case Failure::Kind::no_stress:
      text << why_no_stress(body.block_of(failure.point));
      break;
    case Failure::Kind::not_finite:
      text << "its strain is not a number (places are not, or two points met). Likely causes: a step above the stable "
              "one, a load too sudden, an expression without a value";
  }
  return text.str();
}

}  // namespace strut
