// Writes results to one file on any number of ranks. Columns are sorted into the order of the file in slices, one per
// rank, and sent to rank 0 in portions: the file does not depend on the partition, and no rank has all of a column.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/parallel/communicator.hpp"
#include "io/check_sum.hpp"
#include "io/exodus/elements.hpp"
#include "io/exodus/exodus.hpp"
#include "io/exodus/exodus_file.hpp"
#include "io/exodus/exodus_words.hpp"
#include "io/file_lock.hpp"
#include "io/netcdf/classic_netcdf.hpp"
#include "io/on_root.hpp"
#include "io/slices.hpp"

namespace strut::io {

std::vector<std::string> component_names(int components) {
  if (components == 3) return {"X", "Y", "Z"};
  if (components == 6) return {"XX", "YY", "ZZ", "XY", "YZ", "ZX"};
  if (components == 9) return {"XX", "XY", "XZ", "YX", "YY", "YZ", "ZX", "ZY", "ZZ"};
  return {};
}

namespace {

std::vector<std::string> names_of(const OutputField& field) {
  if (field.components == 1) return {field.name};
  std::vector<std::string> names = component_names(field.components);
  if (names.empty()) {
    throw Error("output field '" + field.name + "' has " + std::to_string(field.components) +
                " components; 1, 3, 6 and 9 can be written");
  }
  for (std::string& name : names) name = field.name + name;
  return names;
}

}  // namespace

std::string result_problem(const PointCloud& cloud, const Communicator& communicator) {
  constexpr auto most = static_cast<double>(std::numeric_limits<std::int32_t>::max());  // see ExodusFile::create
  double largest = 0;
  for (const std::int64_t number : cloud.element_ids)
    largest = std::max(largest, std::abs(static_cast<double>(number)));
  largest = communicator.max(largest);
  if (largest > most) {
    return "a result holds numbers of " + std::string(word(cloud.at)) + "s up to 2147483647, but the mesh has " +
           std::to_string(static_cast<std::int64_t>(largest)) + "; expected smaller ones in the mesh's map of numbers";
  }
  for (const auto& names : {cloud.set_names, cloud.block_names}) {
    for (const std::string& name : names) {
      if (name.size() <= ExodusFile::longest_name) continue;
      return "a result holds names of up to " + std::to_string(ExodusFile::longest_name) + " bytes, but '" + name +
             "' has " + std::to_string(name.size()) + "; expected a shorter one";
    }
  }
  return "";
}

struct ExodusWriter::File {
  const Communicator communicator;
  const std::vector<OutputField> fields;
  const std::size_t points;  // on this rank
  const Slices slices;       // nodes are in their order, and so are elements within each block

  std::optional<FileLock> lock;  // held until the file is closed

  std::optional<ExodusFile> exodus;       // on rank 0 only
  std::vector<ExodusFile::Block> blocks;  // the same on all ranks
  std::vector<std::vector<int>> places;   // indices in this rank's slice of the elements of each block
  int steps = 0;
  std::vector<double> times;  // of the frames; last_values: checksum of the last one; on rank 0
  CheckSum last_values;

  File(const Communicator& comm, const PointCloud& cloud, std::vector<OutputField> output)
      : communicator(comm), fields(std::move(output)), points(cloud.size()), slices(comm, cloud.ids) {}

  void begin(const std::filesystem::path& path, const PointCloud& cloud, double sum, std::optional<double> uncounted) {
    if (slices.size() == 0) throw Error(path.string() + ": there are no points to write");
    define_blocks(cloud);
    run_on_root(communicator, [&] { lock.emplace(path, steps > 0 ? FileLock::File::there : FileLock::File::made); });
    if (steps == 0) return create(path, cloud);
    run_on_root(communicator, [&] { go_on(path, sum, uncounted); });
    steps = static_cast<int>(communicator.max(steps));
  }

  // First the layout, then the data: if the layout grew later, the library would have to move the data.
  void create(const std::filesystem::path& path, const PointCloud& cloud) {
    const std::vector<std::uint64_t> bits = slices.to_slices(std::span(cloud.sets));
    const std::vector<std::int64_t> numbers = numbers_of(cloud.set_names, "nodelist_");
    std::vector<ExodusFile::NodeSet> sets;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const auto has = [k](std::uint64_t of_point) { return (of_point >> k & 1) != 0; };
      const auto size = static_cast<std::int64_t>(std::count_if(bits.begin(), bits.end(), has));
      sets.push_back({numbers[k], cloud.set_names[k], communicator.sum(size)});
    }
    run_on_root(communicator, [&] { define(path, sets); });
    OnRoot on_root(communicator);
    write_nodes(cloud, on_root);
    write_elements(cloud, on_root);
    for (std::size_t k = 0; k < sets.size(); ++k) {
      in_portions(nodes_of_set(bits, k), on_root,
                  [&](const auto& nodes, std::int64_t first) { exodus->put_nodes_of(sets[k], nodes, first); });
    }
    on_root([&] { exodus->flush(); });
    on_root.raise();
  }

  // Drops frames beyond the first `steps`, because the run computes them again. The last one may be incomplete: when
  // the library extends a file, it counts a frame as soon as it begins to write it, and the run may be killed then.
  void go_on(const std::filesystem::path& path, double sum_then, std::optional<double> uncounted) {
    const auto wrong = [&](const std::string& what) {
      throw Error(path.string() + ": is not the result that the run left: " + what);
    };
    if (is_hdf5(path)) wrong("it is in the format netCDF-4 (HDF5), expected the classic one (was it converted?)");
    {
      const ExodusFile found = ExodusFile::open(path, ExodusFile::Access::read, steps);
      if (!fits(found)) wrong("it has other points or fields, or fewer than " + std::to_string(steps) + " frames");
      take_frames(found);
      if (sum() != sum_then)
        wrong("its frames are of other times, or the last one before the checkpoint has other values");
      const std::vector<double> all = found.times();
      const bool follows = std::ssize(all) > steps && all[static_cast<std::size_t>(steps)] == uncounted;
      if (follows && classic_netcdf_problem(path, steps + 1).empty()) ++steps, take_frames(found);
    }
    keep_records(path, steps);
    exodus.emplace(ExodusFile::open(path, ExodusFile::Access::write));
  }

  bool fits(const ExodusFile& found) const {
    const auto [element, nodal] = names();
    return found.sizes().nodes == slices.size() && std::ssize(found.times()) >= steps &&
           found.variable_names(ExodusFile::On::elements) == element &&
           found.variable_names(ExodusFile::On::nodes) == nodal;
  }

  // Reads the times of the frames and the content of the last one, in the order in which it was written.
  void take_frames(const ExodusFile& found) {
    constexpr auto portion = static_cast<std::int64_t>(largest_portion);
    const auto add = [&](std::int64_t count, const auto& read) {
      for (std::int64_t begin = 0; begin < count; begin += portion) {
        last_values.add(std::span<const double>(read(begin, std::min(portion, count - begin))));
      }
    };
    last_values = {};
    times = found.times();
    times.resize(static_cast<std::size_t>(steps));
    std::array<int, 2> next = {0, 0};  // next variable: element, nodal
    for (const OutputField& field : fields) {
      for (int c = 0; c < field.components; ++c) {
        const int v = next[field.nodal]++;
        if (field.nodal) {
          add(slices.size(),
              [&](std::int64_t begin, std::int64_t count) { return found.nodal_values(steps - 1, v, begin, count); });
          continue;
        }
        for (const ExodusFile::Block& block : blocks) {
          add(block.elements, [&](std::int64_t begin, std::int64_t count) {
            return found.element_values(steps - 1, v, block, begin, count);
          });
        }
      }
    }
  }

  double sum() const {
    CheckSum all = last_values;
    all.add(std::span<const double>(times));
    return all.value();
  }

  // names of variables: element, nodal
  std::array<std::vector<std::string>, 2> names() const {
    std::array<std::vector<std::string>, 2> names;
    for (const OutputField& field : fields) {
      for (std::string& name : names_of(field)) names[field.nodal].push_back(std::move(name));
    }
    return names;
  }

  void define_blocks(const PointCloud& cloud) {
    const std::vector<int> of_slice = slices.to_slices(std::span(cloud.blocks));
    places.resize(cloud.block_names.size());
    for (std::size_t n = 0; n < of_slice.size(); ++n) places.at(of_slice[n]).push_back(static_cast<int>(n));
    const std::vector<std::int64_t> numbers = numbers_of(cloud.block_names, "block_");
    for (std::size_t b = 0; b < numbers.size(); ++b) {
      const std::int64_t elements = communicator.sum(std::ssize(places[b]));
      blocks.push_back({numbers[b], cloud.block_names[b], "SPHERE", elements, 1, {"radius", "volume"}});
    }
  }

  void define(const std::filesystem::path& path, const std::vector<ExodusFile::NodeSet>& sets) {
    const auto [element, nodal] = names();
    constexpr std::int64_t of_point = 2 * sizeof(double);  // bytes: all attributes of a block
    exodus.emplace(ExodusFile::create(path, of_point * slices.size()));
    exodus->put_sizes(result_title, {3, slices.size(), slices.size(), std::ssize(blocks), std::ssize(sets)});
    exodus->put_provenance();
    exodus->put_blocks(blocks);
    exodus->put_node_sets(sets);
    exodus->put_variables(blocks, nodal, element);
  }

  void write_nodes(const PointCloud& cloud, OnRoot& on_root) {
    using Place = std::array<double, 3>;  // as it is sent
    std::vector<Place> mine;
    for (const Vector& X : cloud.positions) mine.push_back({X[0], X[1], X[2]});
    in_portions(slices.to_slices(std::span<const Place>(mine)), on_root,
                [this](std::span<const Place> portion, std::int64_t first) {
                  std::array<std::vector<double>, 3> x;
                  for (const Place& place : portion) {
                    for (int k = 0; k < 3; ++k) x[k].push_back(place[k]);
                  }
                  exodus->put_coordinates(x, first);
                });
  }

  void write_elements(const PointCloud& cloud, OnRoot& on_root) {
    const std::vector<std::int64_t> numbers = slices.to_slices(std::span(cloud.element_ids));
    const std::vector<double> volumes = slices.to_slices(std::span(cloud.volumes));
    std::int64_t before = 0;  // number of elements in the blocks before
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      in_portions(of_block(b, numbers), on_root, [&](const auto& portion, std::int64_t first) {
        exodus->put_element_numbers(portion, before + first);
      });
      before += blocks[b].elements;
      std::vector<std::int64_t> nodes;
      for (const int place : places[b]) nodes.push_back(slices.first() + place + 1);
      in_portions(nodes, on_root, [&](const auto& portion, std::int64_t first) {
        exodus->put_connectivity(blocks[b], portion, first);
      });
      in_portions(of_block(b, volumes), on_root, [&](const auto& portion, std::int64_t first) {
        std::vector<double> radii(portion.begin(), portion.end());
        std::transform(radii.begin(), radii.end(), radii.begin(), sphere_radius);
        exodus->put_attribute(blocks[b], 0, radii, first);
        exodus->put_attribute(blocks[b], 1, portion, first);
      });
    }
  }

  std::vector<std::int64_t> nodes_of_set(const std::vector<std::uint64_t>& sets, std::size_t set) const {
    std::vector<std::int64_t> nodes;
    std::int64_t node = slices.first();
    for (const std::uint64_t bits : sets) {
      ++node;
      if (bits >> set & 1) nodes.push_back(node);
    }
    return nodes;
  }

  std::string size_problem(std::span<const std::vector<double>> columns) const {
    if (columns.size() != fields.size()) {
      return "output has " + std::to_string(columns.size()) + " columns for " + std::to_string(fields.size()) +
             " fields";
    }
    for (std::size_t k = 0; k < fields.size(); ++k) {
      if (columns[k].size() != points * static_cast<std::size_t>(fields[k].components)) {
        return "output field '" + fields[k].name + "' has " + std::to_string(columns[k].size()) + " values for " +
               std::to_string(points) + " points of " + std::to_string(fields[k].components) + " components";
      }
    }
    return "";
  }

  void write_nodal(int variable, const std::vector<double>& values, OnRoot& on_root) {
    in_portions(values, on_root, [&](const auto& portion, std::int64_t first) {
      exodus->put_nodal_values(steps, variable, portion, first);
      last_values.add(portion);
    });
  }

  void write_element(int variable, const std::vector<double>& values, OnRoot& on_root) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      in_portions(of_block(b, values), on_root, [&](const auto& portion, std::int64_t first) {
        exodus->put_element_values(steps, variable, blocks[b], portion, first);
        last_values.add(portion);
      });
    }
  }

  // Collective. Calls put(portion, number of its first value) on rank 0, for the values of all ranks in their order.
  template <class T, class Put>
  void in_portions(const std::vector<T>& mine, OnRoot& on_root, const Put& put) const {
    std::int64_t begin = 0;
    gatherv<T>(communicator, mine, [&](std::span<const T> portion) {
      on_root([&] { put(portion, begin); });
      begin += std::ssize(portion);
    });
  }
  template <class T>
  std::vector<T> of_block(std::size_t block, const std::vector<T>& of_slice) const {
    std::vector<T> values;
    values.reserve(places[block].size());
    for (const int place : places[block]) values.push_back(of_slice[place]);
    return values;
  }
};

ExodusWriter::ExodusWriter(const std::filesystem::path& file, const Communicator& communicator, const PointCloud& cloud,
                           std::vector<OutputField> fields, int frames, double sum, std::optional<double> uncounted)
    : file_(std::make_unique<File>(communicator, cloud, std::move(fields))) {
  file_->steps = frames;
  file_->begin(file, cloud, sum, uncounted);
}

ExodusWriter::~ExodusWriter() = default;

int ExodusWriter::frames() const { return file_->steps; }
double ExodusWriter::sum() const { return file_->sum(); }

void ExodusWriter::sync() const {
  run_on_root(file_->communicator, [this] { force_to_disk(file_->exodus->path()); });
}

void ExodusWriter::write(double time, std::span<const std::vector<double>> columns) {
  const Communicator& communicator = file_->communicator;
  raise_together(communicator, file_->size_problem(columns));
  OnRoot on_root(communicator);
  on_root([&] { file_->exodus->put_time(file_->steps, time); });
  file_->times.push_back(time);
  file_->last_values = {};
  std::array<int, 2> variable = {0, 0};  // next variable: element, nodal
  for (std::size_t k = 0; k < file_->fields.size(); ++k) {
    const OutputField& field = file_->fields[k];
    for (int c = 0; c < field.components; ++c) {
      const int v = variable[field.nodal]++;
      const auto values = file_->slices.to_slices(std::span(columns[k]), field.components, c);
      field.nodal ? file_->write_nodal(v, values, on_root) : file_->write_element(v, values, on_root);
    }
  }
  on_root([&] { file_->exodus->flush(); });
  on_root.raise();
  ++file_->steps;
}

}  // namespace strut::io
