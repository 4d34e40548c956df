#include "setup/families.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/timing.hpp"
#include "io/exodus/exodus.hpp"
#include "mechanics/formulation/quadratic_fits.hpp"
#include "setup/blocks.hpp"
#include "setup/dropped.hpp"
#include "setup/found_points.hpp"
#include "topology/partition.hpp"

namespace strut {

namespace {

// Owned points whose family has no invertible shape tensor; `text` describes the first one.
std::vector<int> degenerate_points(const deck::Deck& deck, const Domain& domain, const std::vector<Crack>& cracks,
                                   std::string& text) {
  std::vector<int> found;
  std::vector<Formulation> formulations;  // of blocks
  for (const std::string& name : domain.cloud.block_names) {
    formulations.push_back(deck.materials[section_of(deck, name)->material].formulation);
  }
  for (int i = 0; i < domain.owned; ++i) {
    const LatticeFamilies* stencil = domain.families.lattice(i);
    if (stencil && stencil->spans_space(i)) continue;  // needs no sum over the family
    const Formulation formulation = formulations[domain.cloud.blocks[i]];
    const bool may_be_alone = deck.discretization.degenerate == deck::DegeneratePoints::keep;
    if (formulation == Formulation::ordinary && (may_be_alone || domain.families.size(i) > 0))
      continue;  // an ordinary solid may consist of chains and pairs
    const char* reason = degeneracy(domain.families.size(i), family_spread(domain, i));
    if (!reason && formulation == Formulation::quadratic && !spans_cell(domain, i)) reason = "they hardly span space";
    if (!reason) continue;
    found.push_back(i);
    if (found.size() > 1) continue;
    const Vector X = domain.reference(i);
    const bool is_cut =
        std::ranges::any_of(cracks, [&](const Crack& crack) { return !points_on(crack, {i}, domain).empty(); });
    int largest = i;  // in volume, of its family
    domain.families.for_each(i, [&](int j) { largest = domain.volume(j) > domain.volume(largest) ? j : largest; });
    const bool outweighs = domain.volume(largest) > 1e3 * domain.volume(i);
    text = text_of(word(domain.cloud.at), " ", domain.cloud.element_ids[i], " of block ",
                   domain.cloud.block_names[domain.cloud.blocks[i]], " at ", place_text(X), " has ",
                   domain.families.size(i), " neighbors: ", reason,
                   is_cut ? "; a crack (Bond Filters) runs through it and cuts its bonds to both sides: expected one "
                            "between layers of points. Move the crack"
                   : outweighs ? text_of("; that at ", place_text(domain.reference(largest)), " has a volume of ",
                                         domain.volume(largest), " m³ and outweighs the others, the point itself ",
                                         domain.volume(i), " m³. Mend the mesh")
                               : ". Enlarge the horizon, mend the mesh");
  }
  return found;
}

PointCloud without(const PointCloud& cloud, const std::vector<int>& dropped) {
  std::vector<int> kept;
  for (int i = 0; i < static_cast<int>(cloud.size()); ++i) {
    if (!std::binary_search(dropped.begin(), dropped.end(), i)) kept.push_back(i);
  }
  return reordered(cloud, kept);
}

void refuse_degenerate(std::int64_t count, std::string text, const Communicator& communicator) {
  if (!text.empty()) {
    text = "Discretization > Degenerate Points: " + std::to_string(count) + " points have too few neighbors; " + text +
           ", or say \"Drop\" to leave such points out";
  }
  raise_together(communicator, text);
}

struct FlatCrack {
  Crack crack;
  Vector normal;
};

std::vector<FlatCrack> flat_parts(const Crack& crack) {
  if (const auto* rectangle = std::get_if<RectangularCrack>(&crack)) return {{crack, rectangle->normal}};
  if (const auto* disk = std::get_if<DiskCrack>(&crack)) return {{crack, disk->normal}};
  std::vector<FlatCrack> parts;
  for (const auto& triangle : std::get<TriangulatedCrack>(crack).triangles) {
    const Vector normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
    parts.push_back({TriangulatedCrack{{triangle}}, normal});
  }
  return parts;
}

}  // namespace

std::vector<Crack> cracks_of(const deck::Deck& deck, const Communicator& communicator) {
  std::vector<Crack> cracks = deck.discretization.cracks;
  const auto is_from_a_file = [](const Crack& crack) { return std::holds_alternative<TriangulatedCrack>(crack); };
  if (std::ranges::any_of(cracks, is_from_a_file)) return cracks;  // read before
  for (const auto& file : deck.discretization.shells) {
    cracks.emplace_back(TriangulatedCrack{io::read_shells(file, communicator)});
  }
  return cracks;
}

std::vector<int> points_on(const Crack& crack, const std::vector<int>& points, const Domain& domain) {
  const std::vector<FlatCrack> parts = flat_parts(crack);
  std::vector<int> found;
  for (const int i : points) {
    const Vector X = domain.reference(i);
    const bool is_on = std::ranges::any_of(parts, [&](const FlatCrack& part) {
      const Vector bond = domain.cloud.spacings[i] * part.normal;
      return crosses(part.crack, X, X + bond) && crosses(part.crack, X, X - bond);
    });
    if (is_on) found.push_back(i);
  }
  return found;
}

void read_cracks(deck::Deck& deck, const Communicator& communicator) {
  const Timed timed(phase("Families"));
  deck.discretization.cracks = cracks_of(deck, communicator);
}

// Builds the families of the partitioned cloud and drops degenerate points. Dropping one may make others degenerate.
Domain domain_without_degenerate_points(const deck::Deck& deck, PointCloud cloud, const std::vector<Mirror>& mirrors,
                                        const std::vector<Period>& periods, const Communicator& communicator,
                                        Dropped& dropped) {
  const Timed timed(phase("Families"));
  const std::vector<BlockBonds> bonds = block_bonds(deck, cloud);
  const deck::DegeneratePoints rule = deck.discretization.degenerate;
  const std::vector<Crack> cracks = cracks_of(deck, communicator);
  PiecesOfPoints before;
  for (;;) {
    Domain domain = make_domain(std::move(cloud), bonds, communicator, cracks, mirrors, periods);
    std::string text;
    const std::vector<int> degenerate = degenerate_points(deck, domain, cracks, text);
    const std::int64_t count = communicator.sum(static_cast<std::int64_t>(degenerate.size()));
    const bool refuses = rule == deck::DegeneratePoints::error || rule == deck::DegeneratePoints::keep;
    if (count > 0 && refuses) refuse_degenerate(count, text, communicator);
    if (count == 0) {
      if (dropped.points > 0) take_pieces(domain, before, dropped);
      if (rule == deck::DegeneratePoints::drop) check_dropped(domain, dropped);
      return domain;
    }
    if (dropped.points == 0) before = pieces_of_points(domain);
    dropped.points += count;
    cloud = without(whole_cloud(domain), degenerate);
    if (communicator.sum(static_cast<std::int64_t>(cloud.size())) == 0) {
      raise_together(communicator, "Discretization > Degenerate Points: no point is left after dropping");
    }
  }
}

}  // namespace strut
