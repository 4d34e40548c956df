#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <type_traits>

#include "advice/checks.hpp"
#include "base/text.hpp"
#include "setup/blocks.hpp"
#include "setup/periods.hpp"
#include "topology/bounding_box.hpp"

namespace strut {

namespace {

// Plausible ranges: from foams of a few kg/m³ to osmium; from soft foams to diamond, 18 km/s.
constexpr double least_density = 10, most_density = 30e3;         // kg/m³
constexpr double least_wave_speed = 100, most_wave_speed = 20e3;  // m/s
constexpr double least_of_elastomers = 10;                        // m/s, of gels, and rubbers with a small bulk modulus
// Yield stress over Young's modulus: soft pure metals have some 1e-5, whiskers and polymers almost 0.1.
constexpr double least_yield = 1e-7, most_yield = 0.1;
// Hardening of a metal up to a plastic strain of 1 over its yield stress: at least 1 of 50 MPa, if any.
constexpr double least_hardening = 1e-4;
constexpr double least_heat = 20, most_heat = 20e3;  // J/(kg K): gold has 130, water 4200
// Plausible sizes, m: smaller bodies are a few atoms across, larger ones no specimens. A wave should cross a body
// larger than `long_for_waves` in the run; with lengths in mm taken for m, it covers a thousandth of it.
constexpr double least_size = 1e-8, most_size = 1e3, long_for_waves = 0.5;  // m
// In the same case equilibria, and runs in which waves cross the body so many times, have bodies of tons.
constexpr double most_mass = 1e4;  // kg: a cube of foam of 4 mm weighs 19 t if these are m
constexpr double crossings_of_slow = 100;

// Soft rubbers expand by 3e-4 1/K; rubber on rubber has a friction of 1 to 4; tin melts at 505 K, lead at 601 K, which
// in °C are below 400.
constexpr double most_expansion = 1e-3, most_friction = 5, least_melting = 400;
constexpr double gravity = 9.81, alike_gravity = 0.02;  // m/s²

// Yield stress of the undeformed material over Young's modulus; infinite if it never yields.
double yield_ratio(const BlockMaterial& material) {
  return std::visit(
      []<class L>(const L& law) {
        const materials::Moduli moduli = law.moduli();
        const double E = 9 * moduli.bulk * moduli.shear / (3 * moduli.bulk + moduli.shear);
        return law.flow_stress(materials::virgin_state_of(law)) / E;
      },
      material.law);
}

// Rise of the flow stress up to a plastic strain of 1, over that of the undeformed material; 0 if the flow stress
// depends on more than the plastic strain.
double hardening(const BlockMaterial& material) {
  return std::visit(
      []<class L>(const L& law) {
        if constexpr (requires(typename L::State state) { state.equivalent_plastic_strain; }) {
          typename L::State state = materials::virgin_state_of(law);
          const double yield = law.flow_stress(state);
          state.equivalent_plastic_strain = 1;
          return law.flow_stress(state) / yield - 1;
        }
        return 0.0;
      },
      material.law);
}

Eigen::AlignedBox3d box_of(const Body& body) {
  Eigen::AlignedBox3d box;
  for (int i = 0; i < body.owned(); ++i) box.extend(body.domain.reference(i));
  return common_box(box, body.domain.communicator);
}

// Collective. For each body, the fastest wave speed of the blocks that are bonded to images through the sides, m/s; 0
// without any.
std::vector<double> wave_speeds_through(int axis, const std::vector<Vector>& shifts, const Body& body) {
  const Domain& domain = body.domain;
  std::vector<double> speeds(domain.body_count(), 0);
  for (int i = domain.interior; i < domain.owned; ++i) {
    double& fastest = speeds[domain.body_of(i)];
    const double speed = wave_speed(body.block_of(i).material);
    domain.families.for_each(i, [&](int j) { fastest = shifts[j][axis] != 0 ? std::max(fastest, speed) : fastest; });
  }
  domain.communicator.max(speeds);
  return speeds;
}

// The least and the largest of all blocks, m/s.
std::ranges::minmax_result<double> wave_speeds(const Body& body) {
  std::vector<double> speeds;
  for (const MaterialBlock& block : body.blocks) speeds.push_back(wave_speed(block.material));
  return std::ranges::minmax(speeds);
}

// Largest difference of the velocities of points and tools, m/s.
double largest_difference(const Situation& situation) {
  const Scene& scene = situation.scene;
  const double start = situation.start, duration = situation.duration;
  const double moment = first_moment * duration;
  Eigen::AlignedBox3d velocities;
  for (const Trajectory& one : situation.trajectories) velocities.extend(one.velocities);
  for (const RigidTool& tool : tools_of(scene.conditions))
    velocities.extend(Vector((tool.offset(start + moment) - tool.offset(start)) / moment));
  return velocities.isEmpty() ? 0 : velocities.diagonal().norm();
}

std::string improbable_frictions(const Situation& situation) {
  double most = 0;
  for (const contact::Interaction& one : situation.interactions) most = std::max(most, one.model.friction);
  for (const RigidTool& tool : tools_of(situation.scene.conditions)) most = std::max(most, tool.friction);
  if (!(most > most_friction)) return "";
  return text_of("WARNING: a Friction Coefficient is ", most,
                 "; of solids it is 0 to 2: is it force over force, not percent (20 % are 0.2)?\n");
}

// A load of 9.81 per volume of a solid is a thousandth of its weight or less: it was meant per mass.
std::string weights_by_mass(const Situation& situation) {
  const Body& body = situation.scene.body;
  const Vector middle = box_of(body).center();
  std::string text;
  situation.scene.conditions.visit([&](const BodyForce& one) {
    const double value = one.value.evaluate(middle, situation.start + situation.duration);
    const double here = one.points.empty() ? -1 : body.domain.cloud.blocks[one.points.front()];
    const double loaded = body.domain.communicator.max(here);
    if (loaded < 0 || !(std::abs(std::abs(value) - gravity) < alike_gravity)) return;
    const MaterialBlock& block = body.blocks[static_cast<std::size_t>(loaded)];
    text += text_of("WARNING: ", one.value.path(), " is ", value,
                    " N/m³, a force per volume: the weight of 1 m³ of block '", block.name, "' is ",
                    gravity * block.material.density, " N; is it meant in m/s²?\n");
  });
  return text;
}

}  // namespace

std::string outline(const Situation& situation) {
  const Scene& scene = situation.scene;
  const auto [least, most] = wave_speeds(scene.body);
  const Vector size = box_of(scene.body).sizes();
  std::ostringstream text;
  text.precision(4);
  text << "between the outermost points " << size[0] << " x " << size[1] << " x " << size[2] << " m, mass "
       << mass_of(scene.body) << " kg; wave speed " << least;
  if (most > least) text << " to " << most;
  text << " m/s";
  const double difference = largest_difference(situation);
  if (difference > 0 && !scene.quasi_static)
    text << ", speeds up to " << difference << " m/s apart, " << difference / least << " of it";
  return text.str() + "\n";
}

std::string improbable_materials(const Situation& situation) {
  return lines_of_blocks(situation, [](const MaterialBlock& block, std::size_t) {
    const double density = block.material.density, speed = wave_speed(block.material);
    const std::string begin = "WARNING: block '" + block.name + "' ";
    std::ostringstream text;
    text.precision(4);
    if (!(density >= least_density && density <= most_density)) {
      text << begin << "has a density of " << density
           << " kg/m³; solids have 10 to 30,000: is Density in kg/m³ (2.7 g/cm³ are 2700)?\n";
    }
    const bool is_elastomer = std::holds_alternative<materials::Hyperelastic>(block.material.law);
    if (!(speed >= (is_elastomer ? least_of_elastomers : least_wave_speed) && speed <= most_wave_speed)) {
      text << begin << "has a wave speed of " << speed << " m/s; "
           << (is_elastomer ? "elastomers have 10 to 20,000" : "solids have 100 to 20,000")
           << ": are moduli in Pa (70 GPa are 70e9) and the density in kg/m³?\n";
    }
    if (block.material.thermal_expansion > most_expansion) {
      text << begin << "has a Thermal Expansion Coefficient of " << block.material.thermal_expansion
           << " 1/K; solids have less than 1e-3: is it in 1/K (16.5 µm/(m K) are 16.5e-6)?\n";
    }
    const double yield = yield_ratio(block.material);
    if (std::isfinite(yield) && yield > 0 && !(yield >= least_yield && yield <= most_yield)) {
      text << begin << "yields at " << yield
           << " of its Young's modulus; solids have 1e-7 to 0.1: are both in Pa (50 MPa are 50e6)?\n";
    }
    const double hardens = hardening(block.material);
    if (hardens > 1e-12 && hardens < least_hardening) {
      text << begin << "hardens by " << hardens
           << " of its yield stress until a plastic strain of 1, which is nothing: are both in Pa (50 MPa are "
              "50e6)?\n";
    }
    return text.str();
  });
}

namespace {

// Parts of the default of the elastomer as it has relaxed.
constexpr double soft_springs = 0.5, stiff_springs = 1.3;

std::string springs_of(const MaterialBlock& block, const materials::Hyperelastic& elastomer, double duration) {
  const BlockMaterial& material = block.material;
  const double given = coefficient_of(material.stabilization);
  const double usual = usual_coefficient(material.law, material.stabilization, false, PointsAt::elements);
  const materials::Hyperelastic relaxed = elastomer.relaxed(duration);
  const double fitting = usual_coefficient(relaxed, material.stabilization, false, PointsAt::elements) *
                         relaxed.moduli().longitudinal() / elastomer.moduli().longitudinal();
  std::string text;
  if (given > stiff_springs * fitting && relaxed.shear() < elastomer.shear()) {
    text =
        text_of(std::setprecision(2), "WARNING: block '", block.name, "': its elastomer relaxes to ",
                relaxed.shear() / elastomer.shear(),
                " of its shear modulus in the run, but the springs of its stabilization do not relax: loaded slowly "
                "it is too stiff (blocks with the default springs by 4 to 8 % if it relaxes to 0.5, 14 to 20 % if to "
                "0.2, 30 to 130 % if to 0.05); expected Formulation 'Quadratic Correspondence', or for slow loads a "
                "Stabilization Coefficient of ",
                fitting, "\n");
  }
  if (given >= soft_springs * fitting) return text;
  return text + text_of(std::setprecision(2), "WARNING: block '", block.name,
                        "': its elastomer has a Stabilization Coefficient of ", given, "; the default is ", usual,
                        ". Under pressure such springs let zero-energy modes grow: a bar of K = 5 G with 0.01 in the "
                        "place of 0.3, pressed to 0.6 of its length, was 29 % too soft\n");
}

std::string springs_of_foam(const MaterialBlock& block, PointsAt at) {
  const BlockMaterial& material = block.material;
  const double given = coefficient_of(material.stabilization);
  const double usual = usual_coefficient(material.law, material.stabilization, false, at);
  if (given >= std::min(soft_springs * usual, 0.3)) return "";  // 0.3: where bonds break; up to 7 % were measured
  return text_of(std::setprecision(2), "WARNING: block '", block.name,
                 "': its foam has a Stabilization Coefficient of ", given, "; the default is ", usual,
                 ". Between softer springs the layers beside plates are crushed first: blocks of 4 and 8 layers of "
                 "nodes with 0.01 had 5 to 27 % too little force, with a horizon of 2.6 spacings 40 to 60 %\n");
}

}  // namespace

std::string unusual_springs(const Situation& situation) {
  return lines_of_blocks(situation, [&](const MaterialBlock& block, std::size_t) -> std::string {
    const materials::AnyLaw& law = block.material.law;
    if (block.is_quadratic()) return "";
    if (std::holds_alternative<materials::DeshpandeFleck>(law) || std::holds_alternative<materials::PolymerFoam>(law))
      return springs_of_foam(block, situation.scene.body.domain.cloud.at);
    const auto* elastomer = std::get_if<materials::Hyperelastic>(&law);
    const bool has_springs = residual_of(block.material.stabilization) != ResidualKind::none;
    return elastomer && has_springs ? springs_of(block, *elastomer, situation.duration) : "";
  });
}

namespace {

// The metal of a law with a temperature, or nullptr.
const materials::ThermalJ2* hot_metal(const materials::AnyLaw& law) {
  const auto metal_of = []<class L>(const L& one) -> const materials::ThermalJ2* {
    if constexpr (std::is_same_v<L, materials::ThermalJ2>) return &one;
    if constexpr (requires { requires std::is_same_v<decltype(one.metal), materials::ThermalJ2>; }) return &one.metal;
    return nullptr;
  };
  return std::visit(metal_of, law);
}

const materials::JohnsonCookSoftening* softening_of(const materials::ThermalJ2& metal) {
  const auto* flow = std::get_if<materials::SoftenedFlow>(&metal.flow);
  return flow ? std::get_if<materials::JohnsonCookSoftening>(&flow->softening) : nullptr;
}

// The temperature below which a metal does not soften, K; not finite if its law has no such limit.
double reference_temperature(const materials::ThermalJ2& metal) {
  const materials::JohnsonCookSoftening* softening = softening_of(metal);
  return softening ? softening->reference : -std::numeric_limits<double>::infinity();
}

// The failure criterion of a ductile metal, or nullptr.
const materials::JohnsonCookFailure* failure_of(const materials::AnyLaw& law) {
  return std::visit(
      []<class L>(const L& one) -> const materials::JohnsonCookFailure* {
        if constexpr (requires { one.ductility; })
          return std::get_if<materials::JohnsonCookFailure>(&one.ductility.criterion);
        return nullptr;
      },
      law);
}

// A warning if the temperatures of T* differ between softening and failure, which describe one metal.
std::string two_temperature_scales(const MaterialBlock& block, const materials::ThermalJ2& metal) {
  constexpr double differs = 0.05;
  const materials::JohnsonCookFailure* failure = failure_of(block.material.law);
  const materials::JohnsonCookSoftening* softening = softening_of(metal);
  if (!failure || !softening || failure->constants[4] == 0) return "";
  const double span = softening->melting - softening->reference;
  if (std::abs(failure->reference - softening->reference) <= differs * span &&
      std::abs(failure->melting - softening->melting) <= differs * span)
    return "";
  return text_of("WARNING: block '", block.name, "' softens between a Reference Temperature of ", softening->reference,
                 " K and a Melting Temperature of ", softening->melting, " K, and D5 of its Damage Model acts between ",
                 failure->reference, " and ", failure->melting, " K: they are of one metal; expected the same\n");
}

double flow_stress_at(materials::ThermalJ2 metal, double temperature) {
  metal.set_initial_temperature(temperature);
  return metal.flow_stress(metal.virgin_state());
}

// A warning for each condition whose temperatures are below 0 K at the start or at the end of the run.
std::string temperatures_below_zero(const Situation& situation) {
  const Body& body = situation.scene.body;
  std::ostringstream text;
  for (const HeatedPoints& one : body.heated) {
    double least = std::numeric_limits<double>::infinity();
    for (const int i : one.points) {
      const Vector X = body.domain.reference(i);
      for (const double t : {situation.start, situation.start + situation.duration})
        least = std::min(least, one.temperature.evaluate(X, t));
    }
    least = body.domain.communicator.min(least);
    if (least >= 0) continue;
    text << "WARNING: " << one.temperature.path() << " is " << least << " K: is it in K (20 °C are 293 K)?\n";
  }
  return text.str();
}

constexpr double cold = 150;  // K: few tests are colder, and temperatures in °C are lower

std::string improbable_initial_temperature(const std::string& begin, const materials::ThermalJ2& metal,
                                           double reference) {
  constexpr double below_reference = 25;  // K: room temperatures differ by less
  constexpr double melted = 1e-3;         // of the flow stress at room temperature
  const double initial = metal.heating.initial, flow_stress = flow_stress_at(metal, initial);
  std::ostringstream text;
  text.precision(4);
  text << begin << " has an Initial Temperature of " << initial << " K, ";
  if (flow_stress <= melted * flow_stress_at(metal, materials::room_temperature)) {
    text << "at which its metal is molten: its flow stress is " << flow_stress << " Pa; is it in K?\n";
  } else if (initial < cold) {
    text << "which is " << initial - 273.15 << " °C: is it in K (20 °C are 293 K)?\n";
  } else if (initial < reference - below_reference) {
    text << "below the Reference Temperature of " << reference
         << " K at which its softening begins: its flow stress is that at the reference\n";
  } else {
    return "";
  }
  return text.str();
}

std::string improbable_temperatures_of(const MaterialBlock& block, const materials::ThermalJ2& metal) {
  const double initial = metal.heating.initial, reference = reference_temperature(metal);
  const std::string begin = "WARNING: block '" + block.name + "'";
  std::ostringstream text;
  text.precision(4);
  text << improbable_initial_temperature(begin, metal, reference);
  if (std::isfinite(reference) && reference < cold && initial >= cold) {
    text << begin << " softens from a Reference Temperature of " << reference << " K on, which is "
         << reference - 273.15 << " °C; at its Initial Temperature of " << initial << " K it has "
         << flow_stress_at(metal, initial) / flow_stress_at(metal, reference)
         << " of its flow stress: are both in K (20 °C are 293 K)?\n";
  }
  if (const materials::JohnsonCookSoftening* softening = softening_of(metal);
      softening && softening->melting < least_melting) {
    text << begin << " has a Melting Temperature of " << softening->melting
         << " K; metals have more than 400 K: is it in K (tin melts at 505 K)?\n";
  }
  const double heat = metal.heating.capacity / block.material.density;
  if (heat > 0 && !(heat >= least_heat && heat <= most_heat)) {
    text << begin << " has a Specific Heat of " << heat
         << " J/(kg K); solids have 100 to 5,000: is it in J/(kg K) (0.383 kJ/(kg K) are 383)?\n";
  }
  if (metal.shear_fall > 0 && metal.shear_reference < cold) {
    text << begin << " has its elastic constants at a Shear Modulus Temperature of " << metal.shear_reference
         << " K, which is " << metal.shear_reference - 273.15 << " °C: is it in K (20 °C are 293 K)?\n";
  }
  if (metal.moduli().shear <= (1 + 1e-9) * materials::ThermalJ2::least_shear * metal.shear) {
    text << begin << " has a tenth of its shear modulus at " << initial
         << " K, below which it does not fall; are Shear Modulus Slope (1/K) and Shear Modulus Temperature as meant?\n";
  }
  text << two_temperature_scales(block, metal);
  return text.str();
}

}  // namespace

std::string improbable_temperatures(const Situation& situation) {
  return temperatures_below_zero(situation) + lines_of_blocks(situation, [](const MaterialBlock& block, std::size_t) {
           const materials::ThermalJ2* metal = hot_metal(block.material.law);
           return metal ? improbable_temperatures_of(block, *metal) : std::string();
         });
}

std::string improbable_scales(const Situation& situation) {
  const Scene& scene = situation.scene;
  const double duration = situation.duration;
  const double size = box_of(scene.body).sizes().maxCoeff();
  const auto [least, most] = wave_speeds(scene.body);
  std::ostringstream text;
  text.precision(4);
  text << improbable_frictions(situation) << weights_by_mass(situation);
  if (!(size >= least_size && size <= most_size)) {
    text << "WARNING: the bodies are " << size << " m long: are lengths of the mesh in m?\n";
  } else if (!scene.quasi_static && size > long_for_waves && most * duration < size) {
    text << "WARNING: the bodies are " << size << " m long, and in the " << duration << " s of the run a wave goes "
         << most * duration << " m: are lengths of the mesh in m, not in mm?\n";
  } else if (const double mass = mass_of(scene.body);
             size > long_for_waves && mass > most_mass &&
             (scene.quasi_static || most * duration > crossings_of_slow * size)) {
    text << "WARNING: the bodies are " << size << " m long and weigh " << mass
         << " kg: are lengths of the mesh in m, not in mm?\n";
  }
  const double difference = scene.quasi_static ? 0 : largest_difference(situation);
  if (difference > least) {
    text << "WARNING: speeds are " << difference << " m/s apart, more than the wave speed of " << least
         << " m/s: are velocities in m/s, travels in m and times in s?\n";
  }
  return text.str();
}

std::string large_elastic_strains(const Situation& situation) {
  const Scene& scene = situation.scene;
  // Strain of an impact from which the time step decreases (1.05 times the frequency is allowed), which adds energy to
  // vibrations (docs/decisions.md, Steps that follow the frequency bound); flow and viscosity damp these.
  constexpr double large = 0.05;
  if (scene.quasi_static || scene.control.fixed_dt > 0) return "";
  const double difference = largest_difference(situation);
  return lines_of_blocks(situation, [&](const MaterialBlock& block, std::size_t) -> std::string {
    const double part = difference / wave_speed(block.material);
    if (!(part > large) || block.is_ordinary() || std::isfinite(yield_ratio(block.material))) return "";
    if (block.material.viscosity.any()) return "";
    return text_of(std::setprecision(2), "block '", block.name, "': elastic, and speeds are ", part,
                   " of its wave speed apart: by strains of that order its energy is off by about as much, as its law "
                   "is a rate form and steps that fall while it vibrates give it some; told from 1 % on, kept better "
                   "with Linear Viscosity\n");
  });
}

namespace {

// The largest change of a stretch in the run, and its rate at the start, 1/s.
std::pair<double, double> change_and_rate(const Function& stretch, double start, double duration) {
  const auto change = [&](double part) {
    return stretch.evaluate(0, 0, 0, start + part * duration) - stretch.evaluate(0, 0, 0, start);
  };
  double largest = 0;
  for (int k = 1; k <= 100; ++k) largest = std::max(largest, std::abs(change(0.01 * k)));
  return {largest, change(first_moment) / (first_moment * duration)};
}

// The velocities of the points of each body at the start, m/s.
std::vector<Eigen::AlignedBox3d> velocities_of_bodies(const Situation& situation) {
  const Domain& domain = situation.scene.body.domain;
  std::vector<Eigen::AlignedBox3d> velocities(domain.body_count());
  for (std::size_t b = 0; b < situation.trajectories.size(); ++b)
    velocities[domain.blocks[b].body].extend(situation.trajectories[b].velocities);
  return velocities;
}

}  // namespace

std::string sudden_stretches(const Situation& situation) {
  // Least strain of the first waves, relative to the largest strain of the run, that is worth a warning.
  constexpr double hardly_seen = 0.01;
  const Scene& scene = situation.scene;
  const Domain& domain = scene.body.domain;
  if (domain.periods.empty() || scene.quasi_static || situation.deck.start_from) return "";
  const std::vector<Eigen::AlignedBox3d> velocities = velocities_of_bodies(situation);
  const std::vector<Vector> shifts = shifts_by_periods(domain);
  std::string text;
  for (const Period& period : domain.periods) {
    const auto [largest, rate] = change_and_rate(period.stretch, situation.start, situation.duration);
    const double speed = std::abs(rate) * period.length;
    const std::vector<double> waves = wave_speeds_through(period.axis, shifts, scene.body);
    bool is_sudden = false;
    for (std::size_t b = 0; b < waves.size(); ++b) {
      const bool follows = velocities[b].isEmpty() || velocities[b].sizes()[period.axis] > 0.5 * speed;
      is_sudden = is_sudden || (waves[b] > 0 && speed > 2 * waves[b] * hardly_seen * largest && !follows);
    }
    if (!is_sudden) continue;
    const char axis = "xyz"[period.axis];
    text += text_of(std::setprecision(4), "WARNING: Boundary Conditions > ",
                    situation.deck.conditions[period.number].name, " > Stretch: the period changes by ", rate,
                    " 1/s from the start, and points at rest follow by waves from the sides; expected, for a "
                    "homogeneous strain, an Initial Velocity of ",
                    rate, "*", axis, " m/s along ", axis, ", or a Stretch that begins slowly\n");
  }
  return text;
}

}  // namespace strut
