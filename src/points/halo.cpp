#include "points/halo.hpp"

#include <Tpetra_Core.hpp>
#include <Tpetra_Distributor.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>

#include "base/parallel/communicator.hpp"

namespace strut {

namespace {

using Map = Tpetra::Map<>;
using GlobalId = Map::global_ordinal_type;
using Buffer = Kokkos::View<double*, Kokkos::HostSpace>;

Teuchos::RCP<const Map> map_of(const Communicator& communicator, const std::vector<GlobalId>& ids) {
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return Teuchos::rcp(
      new Map(unknown, Teuchos::ArrayView<const GlobalId>(ids.data(), ids.size()), 0, communicator.teuchos()));
}

}  // namespace

struct Halo::Plan {
  Teuchos::RCP<Tpetra::Distributor> distributor;  // null where there is one rank
  std::vector<int> sent, receivers, received;  // local indices, the ranks that `sent` go to; as ranks follow each other
  Buffer outgoing, incoming;
};

Halo::Halo(const Communicator& communicator, const std::vector<std::int64_t>& owned,
           const std::vector<std::int64_t>& ghosts)
    : plan_(std::make_unique<Plan>()) {
  if (communicator.size() == 1) return;
  std::vector<GlobalId> ids(owned.begin(), owned.end());
  const auto source = map_of(communicator, ids);
  ids.insert(ids.end(), ghosts.begin(), ghosts.end());
  const auto target = map_of(communicator, ids);
  const Tpetra::Import<> import(source, target);
  plan_->distributor = Teuchos::rcp(new Tpetra::Distributor(import.getDistributor()));
  const auto sent = import.getExportLIDs(), receivers = import.getExportPIDs();
  const auto received = import.getRemoteLIDs();
  plan_->sent.assign(sent.begin(), sent.end());
  plan_->receivers.assign(receivers.begin(), receivers.end());
  plan_->received.assign(received.begin(), received.end());
}

Halo::Halo(std::unique_ptr<Plan> plan) : plan_(std::move(plan)) {}

// Of each pair of ranks, what one sends is in the order in which the other receives it; so is a part of it.
Halo Halo::restricted_to(const Communicator& communicator, const std::vector<std::uint8_t>& wanted) const {
  auto part = std::make_unique<Plan>();
  if (plan_->distributor.is_null()) return Halo(std::move(part));
  for (std::size_t k = 0; k < plan_->sent.size(); ++k) {
    if (wanted[plan_->sent[k]] == 0) continue;
    part->sent.push_back(plan_->sent[k]);
    part->receivers.push_back(plan_->receivers[k]);
  }
  for (const int i : plan_->received) {
    if (wanted[i] != 0) part->received.push_back(i);
  }
  part->distributor = Teuchos::rcp(new Tpetra::Distributor(communicator.teuchos()));
  part->distributor->createFromSends(Teuchos::ArrayView<const int>(part->receivers.data(), part->receivers.size()));
  return Halo(std::move(part));
}

Halo::~Halo() = default;
Halo::Halo(Halo&&) noexcept = default;
Halo& Halo::operator=(Halo&&) noexcept = default;

void Halo::start(const double* data, int stride, int width) const {
  if (plan_->distributor.is_null()) return;
  Plan& plan = *plan_;
  const std::size_t outgoing = plan.sent.size() * width, incoming = plan.received.size() * width;
  if (plan.outgoing.size() != outgoing) Kokkos::resize(plan.outgoing, outgoing);
  if (plan.incoming.size() != incoming) Kokkos::resize(plan.incoming, incoming);
  double* to = plan.outgoing.data();
  for (const int i : plan.sent) to = std::copy_n(data + static_cast<std::size_t>(i) * stride, width, to);
  plan.distributor->doPosts(Kokkos::View<const double*, Kokkos::HostSpace>(plan.outgoing), width, plan.incoming);
  bytes_sent_ += static_cast<std::int64_t>(outgoing * sizeof(double));
}

void Halo::finish(double* data, int stride, int width) const {
  if (plan_->distributor.is_null()) return;
  plan_->distributor->doWaits();
  const double* from = plan_->incoming.data();
  for (const int i : plan_->received) {
    std::copy_n(from, width, data + static_cast<std::size_t>(i) * stride);
    from += width;
  }
}

}  // namespace strut
