#include "points/nearby_ranks.hpp"

#include <Tpetra_Distributor.hpp>
#include <algorithm>

namespace strut {

namespace {

std::vector<Eigen::AlignedBox3d> boxes_of_all(const Eigen::AlignedBox3d& mine, const Communicator& communicator) {
  std::vector<double> corners(6 * communicator.size(), 0);
  // An empty box, turned inside out, must stay finite to be added up.
  const Vector low = mine.isEmpty() ? Vector::Constant(1) : mine.min();
  const Vector high = mine.isEmpty() ? Vector::Constant(-1) : mine.max();
  double* own = &corners[6 * communicator.rank()];
  std::copy_n(low.data(), 3, own);
  std::copy_n(high.data(), 3, own + 3);
  communicator.sum(corners);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (int r = 0; r < communicator.size(); ++r) {
    const double* c = &corners[6 * r];
    boxes.emplace_back(Vector(c[0], c[1], c[2]), Vector(c[3], c[4], c[5]));
  }
  return boxes;
}

}  // namespace

std::vector<double> doubles_from_nearby_ranks(const Eigen::AlignedBox3d& box, std::span<const Vector> places,
                                              std::span<const double> records, int width, double reach,
                                              const Communicator& communicator) {
  if (communicator.size() == 1) return {};
  const auto boxes = boxes_of_all(box, communicator);
  std::vector<double> outgoing;
  std::vector<int> targets;
  for (int r = 0; r < communicator.size(); ++r) {
    if (r == communicator.rank() || boxes[r].isEmpty()) continue;
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (boxes[r].squaredExteriorDistance(places[k]) > reach * reach) continue;
      outgoing.insert(outgoing.end(), records.begin() + k * width, records.begin() + (k + 1) * width);
      targets.push_back(r);
    }
  }
  Tpetra::Distributor distributor(communicator.teuchos());
  const std::size_t arriving = distributor.createFromSends(Teuchos::ArrayView<const int>(targets));
  std::vector<double> incoming(arriving * width);
  const Kokkos::View<const double*, Kokkos::HostSpace> from(outgoing.data(), outgoing.size());
  const Kokkos::View<double*, Kokkos::HostSpace> to(incoming.data(), incoming.size());
  distributor.doPostsAndWaits(from, width, to);
  return incoming;
}

}  // namespace strut
