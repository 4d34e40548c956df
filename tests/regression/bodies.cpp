#include "regression/bodies.hpp"

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "base/errors.hpp"

namespace strut::regression {

io::Mesh Lattice::mesh() const {
  io::Mesh mesh;
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) mesh.nodes.push_back(spacing * Vector(i, j, k));
    }
  }
  mesh.blocks.push_back({"bar", "HEX8", layers(0, nz - plate_layers), {}});
  if (plate_layers > 0) mesh.blocks.push_back({"plate", "HEX8", layers(nz - plate_layers, nz), {}});
  mesh.node_sets = {{"foot", level(0)}, {"top", level(nz)}};
  return mesh;
}

std::vector<int> Lattice::level(int k) const {
  std::vector<int> nodes;
  for (int n = node(0, 0, k); n < node(0, 0, k + 1); ++n) nodes.push_back(n);
  return nodes;
}

std::vector<int> Lattice::layers(int begin, int end) const {
  std::vector<int> nodes;
  for (int k = begin; k < end; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        if (!inside((i + 0.5) * spacing, (j + 0.5) * spacing)) continue;
        for (const int level : {k, k + 1}) {
          for (const int corner :
               {node(i, j, level), node(i + 1, j, level), node(i + 1, j + 1, level), node(i, j + 1, level)}) {
            nodes.push_back(corner);
          }
        }
      }
    }
  }
  return nodes;
}

std::string key(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>\n";
}

std::string section(const std::string& name, const std::string& content) {
  return "<ParameterList name=\"" + name + "\">\n" + content + "</ParameterList>\n";
}

std::string along(const std::string& name, const std::string& type, const std::string& set, const std::string& axis,
                  const std::string& value) {
  return section(name, key("Type", type) + key("Node Set", set) + key("Coordinate", axis) + key("Value", value));
}

std::string plane(const std::string& name, const std::string& type, const std::string& set, const std::string& point,
                  const std::string& normal) {
  return section(name, key("Type", type) + key("Node Set", set) + key("Point", point) + key("Normal", normal));
}

std::string copper(const std::string& plasticity) {
  const std::string model = plasticity.empty() ? "Elastic Correspondence" : "Elastic Plastic Correspondence";
  return section("copper", key("Material Model", model) + key("Density", "8930") + key("Young's Modulus", "117e9") +
                               key("Poisson's Ratio", "0.35") + plasticity);
}

Parts thrown_block(const std::string& contact) {
  Parts parts;
  parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
  parts.blocks.clear();
  for (const std::string name : {"block_1", "block_2"}) {
    parts.blocks += section(name, key("Block Names", name) + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                      key("Separate Body", "true"));
  }
  parts.contact = contact;
  parts.conditions = along("flight", "Initial Velocity", "block_2", "z", "-100");
  parts.times = key("Final Time", "4e-5");
  return parts;
}

std::string changed(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::logic_error("the deck under test does not hold: " + old);
  return text.replace(at, old.size(), replacement);
}

std::string cubes(int block, const Vector& corner, int nx, int ny, int nz, double spacing) {
  std::ostringstream text;
  text.precision(17);
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const Vector X = corner + spacing * Vector(i + 0.5, j + 0.5, k + 0.5);
        text << X[0] << " " << X[1] << " " << X[2] << " " << block << " " << spacing * spacing * spacing << "\n";
      }
    }
  }
  return text.str();
}

std::string contact_by(const std::string& law, const std::vector<std::pair<std::string, std::string>>& interactions,
                       const std::string& radius, const std::string& friction) {
  std::string all;
  for (const auto& [first, second] : interactions) {
    all += section(first + second, key("First Block", first) + key("Second Block", second) + key("Contact Model", "m"));
  }
  const std::string model = law + key("Contact Radius", radius) + key("Friction Coefficient", friction);
  return section("Models", section("m", model)) + section("Interactions", all);
}

std::string contact_of(const std::vector<std::pair<std::string, std::string>>& interactions, const std::string& radius,
                       const std::string& penalty, const std::string& friction) {
  return contact_by(key("Contact Model", "Short Range Force") + key("Spring Constant", penalty), interactions, radius,
                    friction);
}

Table read_history(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line, word;
  if (!std::getline(file, line) || !line.starts_with("# strut ") || !std::getline(file, line))
    throw Error(path.string() + ": no header");
  std::vector<std::string> names;
  for (std::istringstream header(line); std::getline(header, word, ',');) names.push_back(word);
  Table table;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    for (const std::string& name : names) {
      if (!std::getline(row, word, ',')) throw Error(path.string() + ": a short line: " + line);
      table[name].push_back(std::stod(word));
    }
    if (std::getline(row, word, ',')) throw Error(path.string() + ": a long line: " + line);
  }
  return table;
}

Advice told_at_the_start(const deck::Deck& deck, const Communicator& world) {
  return advice(deck, set_up(deck, world));
}

std::string Parts::text() const {
  const auto optional = [](const std::string& name, const std::string& content) {
    return content.empty() ? "" : section(name, content);
  };
  const auto optional_key = [](const std::string& name, const std::string& value) {
    return value.empty() ? "" : key(name, value);
  };
  return "<ParameterList>\n" +
         section("Discretization", key("Type", mesh_type) + key("Input Mesh File", mesh_file) +
                                       optional_key("Points", points) + optional_key("Degenerate Points", degenerate)) +
         optional("Node Sets", node_sets) + section("Materials", materials) + section("Blocks", blocks) +
         optional("Contact", contact) + optional("Boundary Conditions", conditions) +
         section("Solver", times + section("Verlet", verlet)) + optional("Output", output) +
         optional("History", history) + optional("Watch", watch) + optional("Damage Models", damage) +
         "</ParameterList>\n";
}

RunFolder::RunFolder(const Lattice& lattice) : folder_(world) {
  run_on_root(world, [&] { io::write_mesh(folder_ / "bar.g", lattice.mesh()); });
}

std::filesystem::path RunFolder::write(const std::string& name, const std::string& text) const {
  run_on_root(world, [&] { std::ofstream(folder_ / name, std::ios::binary) << text; });
  return folder_ / name;
}

Simulation::Simulation(const RunFolder& folder, const Parts& parts)
    : deck(deck::read(folder.write("deck.xml", parts.text()), folder.world)),
      scene(set_up(deck, folder.world)),
      advice(strut::advice(deck, scene)),
      solver(scene.body, scene.conditions, std::move(scene.contact), scene.control, deck.solver.initial_time,
             std::move(scene.fracture)) {}

Simulation::~Simulation() = default;

Ledger Simulation::go(const std::function<void(const Ledger&)>& look) {
  for (;;) {
    solver.advance_velocity(deck.solver.final_time);
    const Ledger now = solver.ledger();
    look(now);
    if (solver.time() >= deck.solver.final_time) return now;
    solver.advance_position(true);
  }
}

bool Simulation::in_set(int i, const std::string& name) const {
  const PointCloud& cloud = scene.body.domain.cloud;
  for (std::size_t k = 0; k < cloud.set_names.size(); ++k) {
    if (cloud.set_names[k] == name) return (cloud.sets[i] >> k & 1) != 0;
  }
  throw std::logic_error("no set " + name);
}

double Simulation::mass() const {
  double sum = 0;
  for (int i = 0; i < scene.body.owned(); ++i) sum += scene.body.mass(i);
  return scene.body.domain.communicator.sum(sum);
}

double Simulation::volume() const {
  double sum = 0;
  for (int i = 0; i < scene.body.owned(); ++i) sum += scene.body.domain.volume(i);
  return scene.body.domain.communicator.sum(sum);
}

}  // namespace strut::regression
