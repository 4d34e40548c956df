#include "topology/halo.hpp"

#include <Kokkos_Core.hpp>
#include <Tpetra_Distributor.hpp>
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <string>

#include "base/parallel/communicator.hpp"

namespace strut {

namespace {

using Buffer = Kokkos::View<double*, Kokkos::HostSpace>;

template <class T>
Teuchos::ArrayView<const T> view(const std::vector<T>& values) {
  return {values.data(), static_cast<Teuchos::ArrayView<const T>::size_type>(values.size())};
}

// The indices of the ghosts in the order in which they arrive: by owner.
std::vector<int> by_owners(std::span<const int> owners) {
  std::vector<int> order(owners.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int g) { return owners[g]; });
  return order;
}

// The indices of some ids among the owned ones.
template <class Ids>
std::vector<int> places_of(const Ids& wanted, std::span<const std::int64_t> owned) {
  std::vector<int> by_id(owned.size()), places;
  std::iota(by_id.begin(), by_id.end(), 0);
  std::ranges::sort(by_id, {}, [&](int i) { return owned[i]; });
  for (const std::int64_t id : wanted) {
    const auto place = std::ranges::lower_bound(by_id, id, {}, [&](int i) { return owned[i]; });
    if (place == by_id.end() || owned[*place] != id) {
      throw std::logic_error("a rank asks for point " + std::to_string(id) + ", which is not this one's");
    }
    places.push_back(*place);
  }
  return places;
}

}  // namespace

struct Halo::Plan {
  Teuchos::RCP<Tpetra::Distributor> distributor;  // null if there is only one rank
  std::vector<int> sent, receivers, received;     // local indices; ranks that `sent` go to; in the order of ranks
  Buffer outgoing, incoming;
  std::vector<ImagePoint> images;
  std::shared_ptr<Vector> stretch = std::make_shared<Vector>(Vector::Ones());
};

// Each rank asks the owners of its ghosts, which thereby learn what to send to whom.
Halo::Halo(const Communicator& communicator, std::span<const std::int64_t> owned, std::span<const std::int64_t> ghosts,
           std::span<const int> owners, const Images& images)
    : plan_(std::make_unique<Plan>()) {
  std::vector<std::int64_t> asked, own_originals;
  std::vector<int> from;
  for (const int g : by_owners(owners)) {
    const int image = Images::image(ghosts[g]), place = static_cast<int>(owned.size()) + g;
    if (image > 0) plan_->images.push_back({place, -1, images[image]});
    if (image > 0 && owners[g] == communicator.rank()) {
      plan_->images.back().original = static_cast<int>(own_originals.size());
      own_originals.push_back(Images::original(ghosts[g]));
      continue;
    }
    plan_->received.push_back(place);
    asked.push_back(Images::original(ghosts[g]));
    from.push_back(owners[g]);
  }
  const std::vector<int> originals = places_of(own_originals, owned);
  for (ImagePoint& image : plan_->images) {
    if (image.original >= 0) image.original = originals[image.original];
  }
  if (communicator.size() == 1) return;
  Teuchos::Array<std::int64_t> wanted;
  Teuchos::Array<int> receivers;
  plan_->distributor = Teuchos::rcp(new Tpetra::Distributor(communicator.teuchos()));
  plan_->distributor->createFromRecvs(view(asked), view(from), wanted, receivers);
  plan_->sent = places_of(wanted, owned);
  plan_->receivers.assign(receivers.begin(), receivers.end());
  // No rank sends by its plan before all have theirs: without this barrier, three ranks with Tpetra 16.1 and Open MPI
  // 6.0.0rc2 waited for each other in most runs. It is unknown which of the three is at fault.
  communicator.barrier();
}

Halo::Halo(std::unique_ptr<Plan> plan) : plan_(std::move(plan)) {}

// For each pair of ranks, the order of sending equals that of receiving, and so it does for a part of the points.
Halo Halo::restricted_to(const Communicator& communicator, const std::vector<std::uint8_t>& wanted) const {
  auto part = std::make_unique<Plan>();
  part->stretch = plan_->stretch;
  std::ranges::copy_if(plan_->images, std::back_inserter(part->images),
                       [&](const ImagePoint& image) { return wanted[image.ghost] != 0; });
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
  part->distributor->createFromSends(view(part->receivers));
  return Halo(std::move(part));
}

const std::vector<ImagePoint>& Halo::images() const { return plan_->images; }

void Halo::set_stretch(const Vector& stretch) { *plan_->stretch = stretch; }

const Vector& Halo::stretch() const { return *plan_->stretch; }

Halo::~Halo() = default;
Halo::Halo(Halo&&) noexcept = default;
Halo& Halo::operator=(Halo&&) noexcept = default;

namespace {

// Messages consist of doubles, which Tpetra sends; each value takes whole doubles.
std::size_t doubles(std::size_t bytes) { return (bytes + sizeof(double) - 1) / sizeof(double); }

}  // namespace

void Halo::start(const void* first, std::size_t stride, std::size_t width) const {
  if (plan_->distributor.is_null()) return;
  Plan& plan = *plan_;
  const std::size_t each = doubles(width), outgoing = plan.sent.size() * each, incoming = plan.received.size() * each;
  if (plan.outgoing.size() != outgoing) Kokkos::resize(plan.outgoing, outgoing);
  if (plan.incoming.size() != incoming) Kokkos::resize(plan.incoming, incoming);
  double* to = plan.outgoing.data();
  for (const int i : plan.sent) {
    std::memcpy(to, static_cast<const std::byte*>(first) + i * stride, width);
    to += each;
  }
  plan.distributor->doPosts(Kokkos::View<const double*, Kokkos::HostSpace>(plan.outgoing), each, plan.incoming);
}

void Halo::finish(void* first, std::size_t stride, std::size_t width, Reflect reflect) const {
  const auto value_of = [&](int i) { return static_cast<std::byte*>(first) + i * stride; };
  if (!plan_->distributor.is_null()) {
    plan_->distributor->doWaits();
    const double* from = plan_->incoming.data();
    for (const int i : plan_->received) {
      std::memcpy(value_of(i), from, width);
      from += doubles(width);
    }
  }
  for (const ImagePoint& image : plan_->images) {
    if (image.original >= 0) std::memcpy(value_of(image.ghost), value_of(image.original), width);
    reflect(image.by.stretched(*plan_->stretch), value_of(image.ghost));
  }
}

}  // namespace strut
