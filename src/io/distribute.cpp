#include "io/distribute.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace strut::io {

namespace {

// Lengths first, then the names as one text: they may hold any character.
std::vector<std::string> broadcast_names(std::vector<std::string> names, const Communicator& communicator) {
  std::vector<std::uint64_t> lengths;
  std::string text;
  for (const std::string& name : names) {
    lengths.push_back(name.size());
    text += name;
  }
  communicator.broadcast(lengths);
  communicator.broadcast(text);
  names.clear();
  std::size_t begin = 0;
  for (const std::uint64_t length : lengths) {
    names.push_back(text.substr(begin, length));
    begin += length;
  }
  return names;
}

std::vector<std::int64_t> slices(std::int64_t count, int ranks) {
  std::vector<std::int64_t> sizes;
  for (int rank = 0; rank < ranks; ++rank) sizes.push_back(count * (rank + 1) / ranks - count * rank / ranks);
  return sizes;
}

std::vector<double> flattened(const std::vector<Vector>& vectors) {
  std::vector<double> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vector& v : vectors) numbers.insert(numbers.end(), v.data(), v.data() + 3);
  return numbers;
}

// Rank 0 alone knows whether there are any.
bool on_root(bool value, const Communicator& communicator) {
  std::vector<int> flag{value ? 1 : 0};
  communicator.broadcast(flag);
  return flag.front() != 0;
}

std::vector<CellShape> scatter_shapes(const std::vector<CellShape>& whole, const std::vector<std::int64_t>& counts,
                                      const Communicator& communicator) {
  if (!on_root(!whole.empty(), communicator)) return {};
  std::vector<ShapeNumbers> numbers;
  for (const CellShape& shape : whole) numbers.push_back(numbers_of(shape));
  std::vector<CellShape> mine;
  for (const ShapeNumbers& shape : communicator.scatter(std::span<const ShapeNumbers>(numbers), counts)) {
    mine.push_back(shape_of(shape));
  }
  return mine;
}

// How many each point has, then all of them in a row.
std::vector<std::vector<std::int64_t>> scatter_joints(const std::vector<std::vector<std::int64_t>>& whole,
                                                      const std::vector<std::int64_t>& counts,
                                                      const Communicator& communicator) {
  if (!on_root(!whole.empty(), communicator)) return {};
  std::vector<std::int64_t> lengths, all, of_ranks;
  for (const auto& joints : whole) {
    lengths.push_back(static_cast<std::int64_t>(joints.size()));
    all.insert(all.end(), joints.begin(), joints.end());
  }
  const auto my_lengths = communicator.scatter(std::span<const std::int64_t>(lengths), counts);
  auto length = lengths.begin();
  for (const std::int64_t count : counts) {
    const auto end = length == lengths.end() ? length : length + count;
    of_ranks.push_back(std::accumulate(length, end, std::int64_t{0}));
    length = end;
  }
  communicator.broadcast(of_ranks);
  const auto my_joints = communicator.scatter(std::span<const std::int64_t>(all), of_ranks);
  std::vector<std::vector<std::int64_t>> mine;
  auto joint = my_joints.begin();
  for (const std::int64_t count : my_lengths) {
    mine.emplace_back(joint, joint + count);
    joint += count;
  }
  return mine;
}

}  // namespace

PointCloud distribute(const PointCloud& whole, const Communicator& communicator) {
  const auto count = communicator.sum(static_cast<std::int64_t>(whole.size()));
  const std::vector<std::int64_t> counts = slices(count, communicator.size());
  const auto column = [&]<class T>(const std::vector<T>& values) {
    return communicator.scatter(std::span<const T>(values), counts);
  };
  PointCloud mine;
  mine.ids = column(whole.ids);
  mine.element_ids = column(whole.element_ids);
  mine.volumes = column(whole.volumes);
  mine.spacings = column(whole.spacings);
  mine.blocks = column(whole.blocks);
  mine.sets = column(whole.sets);
  mine.shapes = scatter_shapes(whole.shapes, counts, communicator);
  mine.joints = scatter_joints(whole.joints, counts, communicator);

  std::vector<std::int64_t> triple = counts;
  for (std::int64_t& size : triple) size *= 3;
  const std::vector<double> numbers = flattened(whole.positions);
  const std::vector<double> xyz = communicator.scatter(std::span<const double>(numbers), triple);
  for (std::size_t i = 0; i < xyz.size(); i += 3) mine.positions.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);

  const auto has_joints = [](const auto& joints) { return !joints.empty(); };
  std::vector<int> joined{!whole.joints.empty() && std::all_of(whole.joints.begin(), whole.joints.end(), has_joints)};
  communicator.broadcast(joined);
  mine.joined = joined.front() != 0;
  std::vector<PointsAt> at{whole.at};
  communicator.broadcast(at);
  mine.at = at.front();
  mine.block_names = broadcast_names(whole.block_names, communicator);
  mine.set_names = broadcast_names(whole.set_names, communicator);
  return mine;
}

}  // namespace strut::io
