#include "io/distribute.hpp"

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

  std::vector<std::int64_t> triple = counts;
  for (std::int64_t& size : triple) size *= 3;
  const std::vector<double> numbers = flattened(whole.positions);
  const std::vector<double> xyz = communicator.scatter(std::span<const double>(numbers), triple);
  for (std::size_t i = 0; i < xyz.size(); i += 3) mine.positions.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);

  std::vector<PointsAt> at{whole.at};
  communicator.broadcast(at);
  mine.at = at.front();
  mine.block_names = broadcast_names(whole.block_names, communicator);
  mine.set_names = broadcast_names(whole.set_names, communicator);
  return mine;
}

}  // namespace strut::io
