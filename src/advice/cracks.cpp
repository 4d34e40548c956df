#include <algorithm>
#include <cmath>
#include <iomanip>
#include <set>
#include <span>

#include "advice/checks.hpp"
#include "advice/lattice_axes.hpp"
#include "base/text.hpp"
#include "fracture/separation.hpp"
#include "mechanics/hindered_breaks.hpp"
#include "setup/blocks.hpp"

namespace strut {

namespace {

// Least fracture energy of a metal that does not fail at once at yield, J/m²: half its energy density times the length.
constexpr auto least_fracture_energy = []<class L>(const L& law) -> double {
  if constexpr (materials::takes_crack_length<L>) {
    const auto [bulk, shear] = law.moduli();
    const double yield = law.flow_stress(law.virgin_state());
    return 0.5 * law.length * yield * yield * (3 * bulk + shear) / (18 * bulk * shear);
  } else {
    return 0;
  }
};

}  // namespace

std::string sudden_failure(const Situation& situation) {
  return lines_of_blocks(situation, [&](const MaterialBlock& block, std::size_t b) -> std::string {
    const auto& damage = block.material.damage;
    if (!damage || !damage->ductility || !(situation.scene.body.domain.blocks[b].spacing > 0)) return "";
    const double given = damage->ductility->fracture_energy;
    const double least = std::visit(least_fracture_energy, block.material.law);
    if (!(given > 0) || given >= least) return "";
    return text_of(std::setprecision(2), "block '", block.name,
                   "': points hold more energy when they yield than its Fracture Energy, so they fail at once; "
                   "expected more than ",
                   least, " J/m², or a smaller spacing\n");
  });
}

namespace {

// Collective. The axes of a block's lattice, as its point with most neighbors sees them; zero without a point.
Tensor axes_of(const Domain& domain, const MaterialBlock& block) {
  const Communicator& communicator = domain.communicator;
  const auto has_fewer = [&](int i, int j) { return domain.families.size(i) < domain.families.size(j); };
  const auto best = std::max_element(block.points.begin(), block.points.end(), has_fewer);
  const double mine = best == block.points.end() ? -1.0 : static_cast<double>(domain.families.size(*best));
  const double most = communicator.max(mine);
  const int teller = communicator.first_rank(mine >= 0 && mine == most);
  Tensor axes = Tensor::Zero();
  if (teller == communicator.rank()) axes = lattice_axes(domain, *best);
  communicator.sum(std::span<double>(axes.data(), 9));
  return axes;
}

// Collective. The layers of the plates of a block on a lattice, if whole families see both of their faces; 0 for other
// blocks.
int layers_of_plates(const Body& body, const MaterialBlock& block, const BlockHorizons& of_block) {
  const Domain& domain = body.domain;
  const int reach = static_cast<int>(of_block.largest / of_block.spacing * with_round_off);
  if (reach < 1) return 0;
  const int most = 2 * reach;
  const Tensor axes = axes_of(domain, block);
  std::vector<double> counts(3 * most + 1, 0);  // of points that see so many layers along each axis; of all
  for (const int i : block.points) {
    if (body.has_lost_bonds(i)) continue;                    // it sees a crack
    Vector ahead = Vector::Zero(), behind = Vector::Zero();  // spacings
    domain.families.for_each(i, [&](int j) {
      const Vector xi = axes.transpose() * (domain.reference(j) - domain.reference(i)) / of_block.spacing;
      ahead = ahead.cwiseMax(xi), behind = behind.cwiseMax(-xi);
    });
    for (int axis = 0; axis < 3; ++axis) {
      const double layers = 1 + ahead[axis] + behind[axis];
      const bool is_lattice = std::abs(layers - std::round(layers)) < 0.01;
      const bool sees_both = std::max(ahead[axis], behind[axis]) < reach - 0.5;
      if (is_lattice && sees_both) ++counts[axis * most + static_cast<int>(std::lround(layers))];
    }
    ++counts.back();
  }
  domain.communicator.sum(counts);
  const auto layers_along = [&](int axis) {
    for (int layers = 1; layers < most; ++layers) {
      const double seen =
          std::min(1.0, double(most - layers) / layers);  // part of a plate's points that see both faces
      if (counts[axis * most + layers] > 0.5 * seen * counts.back()) return layers;
    }
    return 0;
  };
  int found = 0, pairs = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (const int layers = layers_along(axis)) found = layers, ++pairs;
  }
  return pairs == 1 ? found : 0;  // bars have two pairs of faces
}

}  // namespace

std::string cracks_of_plates(const Situation& situation) {
  constexpr double worth_saying = 0.1;
  const Body& body = situation.scene.body;
  return lines_of_blocks(situation, [&](const MaterialBlock& block, std::size_t b) -> std::string {
    const BlockHorizons& of_block = body.domain.blocks[b];
    const auto& damage = block.material.damage;
    if (!damage || !(damage->fracture_energy > 0) || !block.is_ordinary() || !(of_block.spacing > 0)) return "";
    const int layers = layers_of_plates(body, block, of_block);
    const double part = layers > 0 ? part_in_plates(body, b, layers) : 1;
    if (std::abs(part - 1) < worth_saying) return "";
    return text_of(std::setprecision(2), "block '", block.name, "': in plates of ", layers,
                   layers > 1 ? " layers" : " layer", " a flat cut from face to face dissipates ", part,
                   " of the Fracture Energy, because bonds break as in a lattice without faces; expected more layers, "
                   "or ",
                   1 / part, " times that Fracture Energy\n");
  });
}

std::string coarse_averages(const Situation& situation) {
  constexpr double least = 2;  // spacings
  return lines_of_blocks(situation, [&](const MaterialBlock& block, std::size_t b) -> std::string {
    const auto& damage = block.material.damage;
    const double spacing = situation.scene.body.domain.blocks[b].spacing;
    if (!damage || !damage->ductility || !(damage->ductility->averaging_radius > 0) || !(spacing > 0)) return "";
    const double spacings = damage->ductility->averaging_radius / spacing;
    if (spacings > least * (1 - 1e-3)) return "";
    return text_of(std::setprecision(2), "WARNING: block '", block.name, "': its Averaging Radius is ", spacings,
                   " spacings, so the work to tear it depends on the spacing; expected ", least, " spacings or more\n");
  });
}

std::string noisy_cracks(const Situation& situation) {
  return lines_of_blocks(situation, [&](const MaterialBlock& block, std::size_t b) -> std::string {
    const auto& damage = block.material.damage;
    if (block.is_ordinary() || !damage || damage->ductility || damage->is_gradual) return "";
    if (block.is_quadratic()) {
      return "WARNING: block '" + block.name +
             "' breaks bonds by Formulation 'Quadratic Correspondence' at one critical stretch: its cracks take 0.2 to "
             "1.6 of their fracture energy, and the four integration points of a cell, which have no mirror image of "
             "their own, decide on the order of breaks: expect no symmetric crack. Choose " +
             (damage->fracture_energy > 0 ? "Damage Model 'Cohesive Crack'" : "a Fracture Energy") +
             " (elastic solids; 0.89 to 1.07 of it), or another Formulation\n";
    }
    const BlockHorizons& of_block = situation.scene.body.domain.blocks[b];
    if (!(damage->fracture_energy > 0) || of_block.largest > 2 * of_block.spacing) return "";
    return "WARNING: block '" + block.name +
           "' breaks bonds at one critical stretch by correspondence with a horizon below two spacings: its cracks "
           "take "
           "0.4 to 0.95 of the Fracture Energy; expected a Horizon Factor of 3.015 (0.87 to 1.1 of it)\n";
  });
}

std::string gradual_cracks(const Situation& situation) {
  return lines_of_blocks(situation, [&](const MaterialBlock& block, std::size_t) -> std::string {
    const deck::Block* section = section_of(situation.deck, block.name);
    const DamageModel* model = section ? deck::damage_model_of(*section, situation.deck.damage_models) : nullptr;
    if (!model || model->is_gradual || !block.material.damage->is_gradual) return "";
    return "block '" + block.name +
           "': stress falls before bonds break, as by Damage Model 'Cohesive Crack', so that cracks take the Fracture "
           "Energy (by one critical stretch 0.2 to 1.6 of it)\n";
  });
}

std::string late_breaks(const Situation& situation) {
  const Scene& scene = situation.scene;
  const std::vector<MaterialBlock>& blocks = scene.body.blocks;
  const auto could = [](const MaterialBlock& block) {
    return breaks_at_rest(block) || (block.material.damage && block.material.damage->is_gradual);
  };
  if (!situation.deck.next_solver || std::ranges::none_of(blocks, could)) return "";
  std::string why = hindrance_of_breaks(scene.body);
  if (scene.contact.any()) why = "Contact";
  if (!tools_of(scene.conditions).empty()) why = "tools";
  if (why.empty()) return "";
  return "bonds break only from Solver 2 on, because of " + why +
         ": in equilibria they hold, however far they are stretched, and points do not soften\n";
}

std::string soft_faces(const Situation& situation) {
  std::set<int> touching;
  for (const contact::Interaction& one : situation.interactions) touching.insert({one.first, one.second});
  return lines_of_blocks(situation, [&](const MaterialBlock& block, std::size_t b) -> std::string {
    const auto& damage = block.material.damage;
    if (!damage || !damage->is_gradual || !touching.contains(static_cast<int>(b))) return "";
    return "WARNING: block '" + block.name +
           "' has contact, and cracks by Damage Model 'Cohesive Crack': the cells beside such a crack bear pressure, "
           "but a thousandth of their shear, so faces that meet again give way, and pieces that are thrown or pressed "
           "together may gain some percent of the energy (see Balance_Error); a smaller Safety Factor reduces that\n";
  });
}

// If K > 5/3 G, the bond's part of the dilatation reduces the energy that its break releases (docs/theory.md, By the
// energy of a bond). Criteria of energy check that for each bond, those of stretch do not.
std::string breaks_under_pressure(const Situation& situation) {
  return lines_of_blocks(situation, [](const MaterialBlock& block, std::size_t) -> std::string {
    const auto& damage = block.material.damage;
    if (!damage || !block.is_ordinary()) return "";
    const auto [bulk, shear] = materials::moduli_of(block.material.law);
    if (!(bulk > (5.0 / 3 + 1e-9) * shear)) return "";
    return "block '" + block.name + "': bonds break by their " + (damage->critical_bond_energy ? "energy" : "stretch") +
           ", and Poisson's ratio is above 0.25: " +
           (damage->critical_bond_energy ? "several that break in one step" : "some that break") +
           " under pressure may give some energy (a thousandth of all was seen); told where Fracture_Energy falls "
           "below -1 %\n";
  });
}

std::string improbable_stretches(const Situation& situation) {
  std::string text;
  for (const deck::NamedDamageModel& model : situation.deck.damage_models) {
    const auto& critical = model.model.critical_stretch;
    if (!critical || critical->depends_on_position() || critical->depends_on_time()) continue;
    const double value = critical->evaluate(0, 0, 0, situation.start);
    if (!(value > 1)) continue;
    text += text_of("WARNING: ", critical->path(), ": ", value, ", so bonds break at ", 1 + value,
                    " times their length; is it a fraction (2 % are 0.02)?\n");
  }
  return text;
}

}  // namespace strut
