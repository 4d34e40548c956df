// Results: one file, whatever the number of ranks. Columns come to rank 0 in rank order and are put in the file's order
// there, so the file does not depend on the partition.
#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "io/exodus/elements.hpp"
#include "io/exodus/exodus.hpp"
#include "io/exodus/exodus_file.hpp"
#include "io/exodus/numbering.hpp"
#include "io/file_lock.hpp"
#include "io/netcdf/classic_netcdf.hpp"
#include "io/on_root.hpp"
#include "io/to_disk.hpp"

namespace strut::io {

namespace {

std::vector<std::string> component_names(const OutputField& field) {
  std::vector<std::string> suffixes;
  switch (field.components) {
    case 1:
      return {field.name};
    case 3:
      suffixes = {"X", "Y", "Z"};
      break;
    case 6:
      suffixes = {"XX", "YY", "ZZ", "XY", "YZ", "ZX"};
      break;
    case 9:
      suffixes = {"XX", "XY", "XZ", "YX", "YY", "YZ", "ZX", "ZY", "ZZ"};
      break;
    default:
      throw Error("output field '" + field.name + "' has " + std::to_string(field.components) +
                  " components; 1, 3, 6 and 9 can be written");
  }
  for (std::string& suffix : suffixes) suffix = field.name + suffix;
  return suffixes;
}

// All points, on rank 0: what the layout of the file needs.
struct Gathered {
  std::vector<std::int64_t> ids, element_ids;
  std::vector<double> positions, volumes;
  std::vector<int> blocks;
  std::vector<std::uint64_t> sets;

  Gathered(const PointCloud& cloud, const Communicator& communicator) {
    const auto column = [&]<class T>(const std::vector<T>& values) {
      return communicator.gather(std::span<const T>(values));
    };
    ids = column(cloud.ids);
    element_ids = column(cloud.element_ids);
    volumes = column(cloud.volumes);
    blocks = column(cloud.blocks);
    sets = column(cloud.sets);
    std::vector<double> xyz;
    for (const Vector& x : cloud.positions) xyz.insert(xyz.end(), x.data(), x.data() + 3);
    positions = column(xyz);
  }
};

}  // namespace

struct ExodusWriter::File {
  const Communicator communicator;
  const std::vector<OutputField> fields;
  const std::size_t points;  // of this rank

  std::optional<FileLock> lock;  // until the file is closed

  // On rank 0 only. The orders hold places in the gathered columns.
  std::optional<ExodusFile> exodus;
  std::vector<std::size_t> node_order;     // by id
  std::vector<std::size_t> element_order;  // by block, then by id
  std::vector<std::int64_t> node_of;       // gathered place -> number of its node, from 1
  std::vector<ExodusFile::Block> blocks;
  std::vector<double> buffer;
  int steps = 0;

  File(const Communicator& comm, const PointCloud& cloud, std::vector<OutputField> output)
      : communicator(comm), fields(std::move(output)), points(cloud.size()) {}

  void begin(const std::filesystem::path& path, const PointCloud& cloud, const Gathered& all);
  void create(const std::filesystem::path& path, const PointCloud& cloud, const Gathered& all);
  void go_on(const std::filesystem::path& path);
  std::array<std::vector<std::string>, 2> names() const;  // of variables: element, nodal
  void order(const Gathered& all);
  void define_blocks(const PointCloud& cloud, const Gathered& all);
  void write_elements(const Gathered& all);
  void write_node_sets(const std::vector<ExodusFile::NodeSet>& sets, const Gathered& all);
  std::vector<ExodusFile::NodeSet> node_sets(const PointCloud& cloud, const Gathered& all) const;

  std::string size_problem(std::span<const std::vector<double>> columns) const;
  void write_nodal(int variable, std::span<const double> column, int components, int component);
  void write_element(int variable, std::span<const double> column, int components, int component);
};

void ExodusWriter::File::begin(const std::filesystem::path& path, const PointCloud& cloud, const Gathered& all) {
  if (all.ids.empty()) throw Error(path.string() + ": there are no points to write");
  order(all);
  define_blocks(cloud, all);
  lock.emplace(path, steps > 0 ? FileLock::File::there : FileLock::File::made);
  steps > 0 ? go_on(path) : create(path, cloud, all);
}

std::array<std::vector<std::string>, 2> ExodusWriter::File::names() const {
  std::array<std::vector<std::string>, 2> names;
  for (const OutputField& field : fields) {
    for (std::string& name : component_names(field)) names[field.nodal].push_back(std::move(name));
  }
  return names;
}

// Frames beyond the first `steps` are dropped: the run comes to them again.
void ExodusWriter::File::go_on(const std::filesystem::path& path) {
  const auto [element, nodal] = names();
  const bool fits = [&] {
    const ExodusFile found = ExodusFile::open(path);
    return found.sizes().nodes == std::ssize(node_order) && std::ssize(found.times()) >= steps &&
           found.variable_names(ExodusFile::On::elements) == element &&
           found.variable_names(ExodusFile::On::nodes) == nodal;
  }();
  if (!fits) {
    throw Error(path.string() + ": is not the result that the run left: it has other points or fields, or fewer than " +
                std::to_string(steps) + " frames");
  }
  keep_records(path, steps);
  exodus.emplace(ExodusFile::open(path, ExodusFile::Access::write));
}

// The layout first, then what fills it: the library would move what is there if the layout grew.
void ExodusWriter::File::create(const std::filesystem::path& path, const PointCloud& cloud, const Gathered& all) {
  const auto [element, nodal] = names();
  const std::vector<ExodusFile::NodeSet> sets = node_sets(cloud, all);
  const auto count = static_cast<std::int64_t>(all.ids.size());

  exodus.emplace(ExodusFile::create(path));
  exodus->put_sizes("strut", {3, count, count, std::ssize(blocks), std::ssize(sets)});
  exodus->put_provenance();
  exodus->put_blocks(blocks);
  exodus->put_node_sets(sets);
  exodus->put_variables(blocks, nodal, element);
  write_elements(all);
  write_node_sets(sets, all);
  exodus->flush();
}

void ExodusWriter::File::order(const Gathered& all) {
  node_order.resize(all.ids.size());
  std::iota(node_order.begin(), node_order.end(), 0);
  std::sort(node_order.begin(), node_order.end(), [&](auto a, auto b) { return all.ids[a] < all.ids[b]; });
  element_order = node_order;
  std::stable_sort(element_order.begin(), element_order.end(),
                   [&](auto a, auto b) { return all.blocks[a] < all.blocks[b]; });
  node_of.resize(all.ids.size());
  for (std::size_t n = 0; n < node_order.size(); ++n) node_of[node_order[n]] = static_cast<std::int64_t>(n + 1);
}

void ExodusWriter::File::define_blocks(const PointCloud& cloud, const Gathered& all) {
  const std::vector<std::int64_t> numbers = numbers_of(cloud.block_names, "block_");
  for (std::size_t b = 0; b < numbers.size(); ++b) {
    blocks.push_back({numbers[b], cloud.block_names[b], "SPHERE", 0, 1, {"radius", "volume"}});
  }
  for (const int block : all.blocks) ++blocks.at(block).elements;
}

void ExodusWriter::File::write_elements(const Gathered& all) {
  std::array<std::vector<double>, 3> x;
  for (int k = 0; k < 3; ++k) {
    for (const std::size_t place : node_order) x[k].push_back(all.positions[3 * place + k]);
  }
  exodus->put_coordinates(x);
  std::vector<std::int64_t> numbers;
  for (const std::size_t place : element_order) numbers.push_back(all.element_ids[place]);
  exodus->put_element_numbers(numbers);

  auto place = element_order.begin();
  for (const ExodusFile::Block& block : blocks) {
    std::vector<std::int64_t> nodes;
    std::vector<double> radii, volumes;
    for (std::int64_t e = 0; e < block.elements; ++e, ++place) {
      nodes.push_back(node_of[*place]);
      volumes.push_back(all.volumes[*place]);
      radii.push_back(sphere_radius(volumes.back()));
    }
    exodus->put_connectivity(block, nodes);
    exodus->put_attribute(block, 0, radii);
    exodus->put_attribute(block, 1, volumes);
  }
}

std::vector<ExodusFile::NodeSet> ExodusWriter::File::node_sets(const PointCloud& cloud, const Gathered& all) const {
  const std::vector<std::int64_t> numbers = numbers_of(cloud.set_names, "nodelist_");
  std::vector<ExodusFile::NodeSet> sets;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto size = std::count_if(all.sets.begin(), all.sets.end(), [&](auto bits) { return bits >> k & 1; });
    sets.push_back({numbers[k], cloud.set_names[k], size});
  }
  return sets;
}

void ExodusWriter::File::write_node_sets(const std::vector<ExodusFile::NodeSet>& sets, const Gathered& all) {
  for (std::size_t k = 0; k < sets.size(); ++k) {
    std::vector<std::int64_t> nodes;
    for (const std::size_t place : node_order) {
      if (all.sets[place] >> k & 1) nodes.push_back(node_of[place]);
    }
    exodus->put_nodes_of(sets[k], nodes);
  }
}

std::string ExodusWriter::File::size_problem(std::span<const std::vector<double>> columns) const {
  if (columns.size() != fields.size()) {
    return "output has " + std::to_string(columns.size()) + " columns for " + std::to_string(fields.size()) + " fields";
  }
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (columns[k].size() != points * static_cast<std::size_t>(fields[k].components)) {
      return "output field '" + fields[k].name + "' has " + std::to_string(columns[k].size()) + " values for " +
             std::to_string(points) + " points of " + std::to_string(fields[k].components) + " components";
    }
  }
  return "";
}

void ExodusWriter::File::write_nodal(int variable, std::span<const double> column, int components, int component) {
  for (std::size_t n = 0; n < buffer.size(); ++n) buffer[n] = column[node_order[n] * components + component];
  exodus->put_nodal_values(steps, variable, buffer);
}

void ExodusWriter::File::write_element(int variable, std::span<const double> column, int components, int component) {
  for (std::size_t e = 0; e < buffer.size(); ++e) buffer[e] = column[element_order[e] * components + component];
  std::size_t begin = 0;
  for (const ExodusFile::Block& block : blocks) {
    exodus->put_element_values(steps, variable, block, std::span<const double>(buffer).subspan(begin, block.elements));
    begin += block.elements;
  }
}

ExodusWriter::ExodusWriter(const std::filesystem::path& file, const Communicator& communicator, const PointCloud& cloud,
                           std::vector<OutputField> fields, int frames)
    : file_(std::make_unique<File>(communicator, cloud, std::move(fields))) {
  file_->steps = frames;
  const Gathered all(cloud, communicator);
  run_on_root(communicator, [&] { file_->begin(file, cloud, all); });
  file_->buffer.resize(all.ids.size());
}

ExodusWriter::~ExodusWriter() = default;
ExodusWriter::ExodusWriter(ExodusWriter&&) noexcept = default;

int ExodusWriter::frames() const { return file_->steps; }

void ExodusWriter::sync() const {
  run_on_root(file_->communicator, [this] { force_to_disk(file_->exodus->path()); });
}

void ExodusWriter::write(double time, std::span<const std::vector<double>> columns) {
  const Communicator& communicator = file_->communicator;
  raise_together(communicator, file_->size_problem(columns));
  OnRoot on_root(communicator);
  on_root([&] { file_->exodus->put_time(file_->steps, time); });
  std::array<int, 2> variable = {0, 0};  // element, nodal
  for (std::size_t k = 0; k < file_->fields.size(); ++k) {
    const OutputField& field = file_->fields[k];
    const std::vector<double> column = communicator.gather(std::span<const double>(columns[k]));
    for (int c = 0; c < field.components; ++c) {
      const int v = variable[field.nodal]++;
      on_root([&] {
        field.nodal ? file_->write_nodal(v, column, field.components, c)
                    : file_->write_element(v, column, field.components, c);
      });
    }
  }
  on_root([&] { file_->exodus->flush(); });
  on_root.raise();
  ++file_->steps;
}

}  // namespace strut::io
