#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <span>
#include <sstream>
#include <utility>

#include "advice/checks.hpp"
#include "base/text.hpp"
#include "setup/found_points.hpp"
#include "setup/periods.hpp"
#include "topology/pieces.hpp"

namespace strut {

namespace {

// A rigid motion of a body: the velocity of its center, and its angular velocity times the radius of gyration.
using RigidMotion = Eigen::Matrix<double, 6, 1>;
using Holds = Eigen::Matrix<double, 6, 6>;  // Σ of the held motions, each times its transpose

// Relative to the largest eigenvalue of a piece's holds: smaller eigenvalues mean free motion. Holding points are at
// least a hundredth of the piece's radius apart, or on one line, for which round-off makes 1e-16.
constexpr double none = 1e-8;
constexpr double touching = 0.1;       // spacings between a tool and points that it holds from the start
constexpr std::size_t most_lines = 3;  // a scan may have many loose pieces

struct Piece {
  std::vector<double> of_block;  // number of its points in each block
  double loaded = 0;             // number of its points on which a Body Force acts
  double reached = 0;            // number of its points that tools may meet
  Vector middle = Vector::Zero();
  Tensor moments = Tensor::Zero();  // Σ |r|² 1 − r⊗r over its points, m²
  double radius = 0;                // of gyration, m
  Holds holds = Holds::Zero();

  double points() const {
    double sum = 0;
    for (const double count : of_block) sum += count;
    return sum;
  }
  // Holds the rotations that move no point, of a line of points or of a single one. On one rank only: holds are summed.
  void hold_what_moves_nothing(bool on_this_rank) {
    const Eigen::SelfAdjointEigenSolver<Tensor> turning(moments);
    radius = std::sqrt(std::max(0.5 * moments.trace() / points(), std::numeric_limits<double>::min()));
    for (int c = 0; c < 3 && on_this_rank; ++c) {
      const Vector axis = turning.eigenvectors().col(c);
      if (turning.eigenvalues()[c] <= none * moments.trace())
        holds.bottomRightCorner<3, 3>() += axis * axis.transpose();
    }
  }
  void hold(const Vector& place, const Vector& direction) {
    RigidMotion motion;
    motion << direction, (place - middle).cross(direction) / radius;
    holds += motion * motion.transpose();
  }
  // The mirror image behind a plane prevents rotation out of the plane.
  void hold_by_image(const Vector& place, const Vector& normal) {
    hold(place, normal);
    holds.bottomRightCorner<3, 3>() += Tensor::Identity() - normal * normal.transpose();
  }
};

// All pieces, on all ranks, and the index of the piece of each owned point.
struct Pieces {
  std::vector<Piece> all;
  std::vector<int> of;
};

// Sums numbers of each piece over all ranks.
void sum(const Communicator& ranks, std::vector<Piece>& pieces, auto&& numbers_of) {
  std::vector<double> numbers;
  for (Piece& piece : pieces) {
    for (const double number : numbers_of(piece)) numbers.push_back(number);
  }
  ranks.sum(numbers);
  auto next = numbers.begin();
  for (Piece& piece : pieces) {
    for (double& number : numbers_of(piece)) number = *next++;
  }
}

Pieces pieces_of(const Domain& domain) {
  auto [of, count] = numbered_pieces(domain);
  Pieces pieces{.of = std::move(of)};
  pieces.all.assign(count, {.of_block = std::vector<double>(domain.blocks.size(), 0)});
  for (int i = 0; i < domain.owned; ++i) {
    Piece& piece = pieces.all[pieces.of[i]];
    ++piece.of_block[domain.cloud.blocks[i]];
    piece.middle += domain.reference(i);
  }
  sum(domain.communicator, pieces.all, [](Piece& piece) { return std::span(piece.of_block); });
  sum(domain.communicator, pieces.all, [](Piece& piece) { return piece.middle.reshaped(); });
  for (Piece& piece : pieces.all) piece.middle /= piece.points();
  for (int i = 0; i < domain.owned; ++i) {
    Piece& piece = pieces.all[pieces.of[i]];
    const Vector r = domain.reference(i) - piece.middle;
    piece.moments += r.squaredNorm() * Tensor::Identity() - r * r.transpose();
  }
  sum(domain.communicator, pieces.all, [](Piece& piece) { return piece.moments.reshaped(); });
  for (Piece& piece : pieces.all) piece.hold_what_moves_nothing(domain.communicator.rank() == 0);
  return pieces;
}

// A body that is bonded to its image one period away can rotate only around the axis of the period.
void hold_by_periods(const Domain& domain, Pieces& pieces) {
  const std::vector<Vector> periods = shifts_by_periods(domain);
  for (int i = domain.interior; i < domain.owned; ++i) {
    domain.families.for_each(i, [&](int j) {
      if (periods[j].isZero(0)) return;
      const Vector along = periods[j].normalized();
      pieces.all[pieces.of[i]].holds.bottomRightCorner<3, 3>() += Tensor::Identity() - along * along.transpose();
    });
  }
}

void hold_by_images(const Domain& domain, Pieces& pieces) {
  if (!domain.periods.empty()) return hold_by_periods(domain, pieces);
  for (int i = 0; i < domain.owned; ++i) {
    for (const Mirror& mirror : domain.mirrors) {
      if (mirror.body != domain.body_of(i)) continue;
      const double distance = std::abs(mirror.distance(domain.reference(i)));
      if (2 * distance > domain.sites[i].horizon()) continue;
      pieces.all[pieces.of[i]].hold_by_image(domain.reference(i), mirror.normal);
    }
  }
}

void hold_by_tools(const Scene& scene, double start, Pieces& pieces) {
  const Domain& domain = scene.body.domain;
  for (const RigidTool& tool : tools_of(scene.conditions)) {
    const Vector offset = tool.offset(start);
    for (const int i : tool.points) {
      ++pieces.all[pieces.of[i]].reached;
      const Vector place = tool.nearest_image(domain, scene.body.current(i) - offset);
      const Surface at = tool.met_by(i, tool.shape, place);
      if (at.gap < touching * domain.cloud.spacings[i]) {
        pieces.all[pieces.of[i]].hold(domain.reference(i), at.normal);
      }
    }
  }
}

void hold(const Scene& scene, double start, double step, Pieces& pieces) {
  const Domain& domain = scene.body.domain;
  for (const HeldDirection& one : held_directions(scene.conditions, scene.body, start, step)) {
    pieces.all[pieces.of[one.point]].hold(domain.reference(one.point), one.direction);
  }
  hold_by_images(domain, pieces);
  hold_by_tools(scene, start, pieces);
  scene.conditions.visit([&](const BodyForce& one) {
    for (const int i : one.points) ++pieces.all[pieces.of[i]].loaded;
  });
  sum(domain.communicator, pieces.all, [](Piece& piece) { return piece.holds.reshaped(); });
  sum(domain.communicator, pieces.all, [](Piece& piece) { return std::span(&piece.loaded, 1); });
  sum(domain.communicator, pieces.all, [](Piece& piece) { return std::span(&piece.reached, 1); });
}

// The number of pieces with points of each block.
std::vector<int> counts_of_pieces(const std::vector<Piece>& pieces, std::size_t blocks) {
  std::vector<int> counts(blocks, 0);
  for (const Piece& piece : pieces) {
    for (std::size_t b = 0; b < blocks; ++b) counts[b] += piece.of_block[b] > 0;
  }
  return counts;
}

// True if contact is declared between the piece and another one.
bool may_be_pushed(const Piece& piece, const std::vector<int>& counts,
                   const std::vector<contact::Interaction>& interactions) {
  const auto meets = [&](int own, int other) {
    return piece.of_block[own] > 0 && counts[other] > (piece.of_block[other] > 0 ? 1 : 0);
  };
  return std::ranges::any_of(interactions, [&](const contact::Interaction& one) {
    return meets(one.first, one.second) || meets(one.second, one.first);
  });
}

std::string along_text(const Vector& v) {
  for (int c = 0; c < 3; ++c) {
    if (std::abs(v[c]) > 1 - 1e-6) return {"xyz"[c]};
  }
  return text_of(std::setprecision(3), "(", v[0], ", ", v[1], ", ", v[2], ")");
}

// The directions in which it can translate freely, of unit length.
std::vector<Vector> free_directions(const Holds& holds) {
  const double least = none * std::max(holds.trace(), 1e-300);
  const Eigen::SelfAdjointEigenSolver<Tensor> along(holds.topLeftCorner<3, 3>());
  std::vector<Vector> free;
  for (int c = 0; c < 3; ++c) {
    if (along.eigenvalues()[c] < least) free.push_back(along.eigenvectors().col(c));
  }
  return free;
}

bool is_free(const Holds& holds) {
  const double least = none * std::max(holds.trace(), 1e-300);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(holds, Eigen::EigenvaluesOnly).eigenvalues()[0] < least;
}

// Describes the free motion; "" if there is none.
std::string freedom(const Holds& holds) {
  const std::vector<Vector> free = free_directions(holds);
  if (free.size() == 3) return "it";
  if (free.size() == 2) return "it but along " + along_text(free[0].cross(free[1]).normalized());
  if (free.size() == 1) return "it along " + along_text(free[0]);
  return is_free(holds) ? "it against turning" : "";
}

std::string name_of(const Piece& piece, const Domain& domain, const std::vector<double>& points_of_blocks) {
  std::string names;
  bool all = true;
  for (std::size_t b = 0; b < piece.of_block.size(); ++b) {
    if (piece.of_block[b] == 0) continue;
    names += (names.empty() ? "" : ", ") + domain.cloud.block_names[b];
    all = all && piece.of_block[b] == points_of_blocks[b];
  }
  if (all) return names;
  return "a piece of " + std::to_string(static_cast<std::int64_t>(piece.points())) + " points of " + names +
         " around " + place_text(piece.middle);
}

}  // namespace

std::string unheld_bodies(const Situation& situation) {
  const Scene& scene = situation.scene;
  const auto& interactions = situation.interactions;
  const double start = situation.start, duration = situation.duration;
  if (!scene.quasi_static) return "";
  const Domain& domain = scene.body.domain;
  Pieces pieces = pieces_of(domain);
  hold(scene, start, duration / scene.quasi_static->load_steps, pieces);
  std::vector<double> points_of_blocks(domain.blocks.size(), 0);
  for (const Piece& piece : pieces.all) {
    for (std::size_t b = 0; b < piece.of_block.size(); ++b) points_of_blocks[b] += piece.of_block[b];
  }
  const std::vector<int> counts = counts_of_pieces(pieces.all, domain.blocks.size());
  std::ostringstream text;
  std::size_t found = 0;
  for (std::size_t p = 0; p < pieces.all.size(); ++p) {
    const std::string free = freedom(pieces.all[p].holds);
    const bool is_pushed = may_be_pushed(pieces.all[p], counts, interactions);
    const bool by_nothing = !is_pushed && pieces.all[p].reached == 0 && free == "it" && pieces.all[p].loaded > 0;
    if (free.empty() || !(is_pushed || by_nothing) || ++found > most_lines) continue;
    const std::string name = name_of(pieces.all[p], domain, points_of_blocks);
    if (by_nothing) {
      text << "WARNING: " << name << ": nothing holds it in these equilibria, and loads act: where they are not in "
           << "balance there is no equilibrium, else it rests anywhere; expected a Prescribed Displacement or a "
              "Symmetry Plane that "
           << "holds it, or Verlet for a body that flies\n";
      continue;
    }
    text
        << "WARNING: " << name << ": only contact and friction hold " << free
        << " in these equilibria; where they do not press it from both sides it is pushed along, and rests "
        << "anywhere short of a force; expected a Prescribed Displacement or a Symmetry Plane that holds it, or Verlet "
        << "for a body that flies\n";
  }
  if (found > most_lines) {
    text << "WARNING: nothing, or only contact and friction, holds " << found - most_lines
         << " more pieces in these equilibria\n";
  }
  return text.str();
}

}  // namespace strut
