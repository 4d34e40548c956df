// Values of points that other ranks own: sent and received while this rank works on points that need none of them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace strut {

class Communicator;

// Built on Tpetra's distributor.
class Halo {
 public:
  // Collective. `owned`, `ghosts`: global ids in the order of local indices (ghosts follow the owned points); `owners`:
  // the ranks that own the ghosts. Each of these must know the id as one of its own.
  Halo(const Communicator& communicator, std::span<const std::int64_t> owned, std::span<const std::int64_t> ghosts,
       std::span<const int> owners);
  // Collective. The same for some of the points: `wanted` of owned points and ghosts, as their owners have it.
  Halo restricted_to(const Communicator& communicator, const std::vector<std::uint8_t>& wanted) const;
  ~Halo();
  Halo(Halo&&) noexcept;
  Halo& operator=(Halo&&) noexcept;

  // Sends `width` consecutive doubles of every owned point that another rank needs: point i's start at
  // data[i * stride]. One exchange at a time; finish() with the same arguments waits and fills the ghosts.
  void start(const double* data, int stride, int width) const;
  void finish(double* data, int stride, int width) const;

  void exchange(double* data, int stride, int width) const {
    start(data, stride, width);
    finish(data, stride, width);
  }

  std::int64_t bytes_sent() const { return bytes_sent_; }  // since the start, by this rank

 private:
  struct Plan;
  explicit Halo(std::unique_ptr<Plan> plan);
  std::unique_ptr<Plan> plan_;
  mutable std::int64_t bytes_sent_ = 0;
};

}  // namespace strut
