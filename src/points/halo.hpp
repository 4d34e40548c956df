// Values of points that other ranks own: sent and received while this rank works on points that need none of them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "points/mirror.hpp"

namespace strut {

class Communicator;

// Makes the numbers of an image from those of its original.
using Reflect = void (*)(const Reflection& by, double* numbers);
void reflect_place(const Reflection& by, double* numbers);
void reflect_direction(const Reflection& by, double* numbers);
// The same of a record that reflect(by, record) is for.
template <class Record>
void reflect_record(const Reflection& by, double* numbers) {
  reflect(by, *reinterpret_cast<Record*>(numbers));
}

// A ghost that is an image by symmetry planes, and its original where that is this rank's own; −1: another's.
struct ImagePoint {
  int ghost, original;
  Reflection by;
};

// Built on Tpetra's distributor.
class Halo {
 public:
  // Collective. `owned`, `ghosts`: global ids in the order of local indices (ghosts follow the owned points); `owners`:
  // the ranks that own the ghosts, or the originals of those that are images. Each of these must know the id, or the
  // original's, as one of its own.
  Halo(const Communicator& communicator, std::span<const std::int64_t> owned, std::span<const std::int64_t> ghosts,
       std::span<const int> owners, const Images& images = {});
  // Collective. The same for some of the points: `wanted` of owned points and ghosts, as their owners have it.
  Halo restricted_to(const Communicator& communicator, const std::vector<std::uint8_t>& wanted) const;
  ~Halo();
  Halo(Halo&&) noexcept;
  Halo& operator=(Halo&&) noexcept;

  // Sends `width` consecutive doubles of every owned point that another rank needs: point i's start at
  // data[i * stride]. One exchange at a time; finish() with the same arguments waits and fills the ghosts. `reflect`:
  // without, the numbers of an image are its original's.
  void start(const double* data, int stride, int width) const;
  void finish(double* data, int stride, int width, Reflect reflect = nullptr) const;

  void exchange(double* data, int stride, int width, Reflect reflect = nullptr) const {
    start(data, stride, width);
    finish(data, stride, width, reflect);
  }
  template <class Record>
  void exchange_records(std::vector<Record>& records) const {
    constexpr int width = sizeof(Record) / sizeof(double);
    exchange(reinterpret_cast<double*>(records.data()), width, width, reflect_record<Record>);
  }

  const std::vector<ImagePoint>& images() const;

  std::int64_t bytes_sent() const { return bytes_sent_; }  // since the start, by this rank

 private:
  struct Plan;
  explicit Halo(std::unique_ptr<Plan> plan);
  std::unique_ptr<Plan> plan_;
  mutable std::int64_t bytes_sent_ = 0;
};

}  // namespace strut
