#include "points/sent_to_ranks.hpp"

#include <Tpetra_Distributor.hpp>

#include "base/parallel/communicator.hpp"

namespace strut {

std::vector<double> sent_to_ranks(std::span<const int> ranks, std::span<const double> records, int width,
                                  const Communicator& communicator) {
  Tpetra::Distributor distributor(communicator.teuchos());
  const std::size_t arriving = distributor.createFromSends(Teuchos::ArrayView<const int>(ranks.data(), ranks.size()));
  std::vector<double> incoming(arriving * width);
  const Kokkos::View<const double*, Kokkos::HostSpace> from(records.data(), records.size());
  const Kokkos::View<double*, Kokkos::HostSpace> to(incoming.data(), incoming.size());
  distributor.doPostsAndWaits(from, width, to);
  return incoming;
}

}  // namespace strut
