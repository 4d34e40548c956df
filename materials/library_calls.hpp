// A fault within a library that a law calls is told as that library's: its file, and the points that it was called for.
#pragma once

#include <array>
#include <string>

namespace strut::materials {

// While it lives, this thread calls a law for these points; X, three numbers each, in m. Other laws do without.
template <class L>
class PointsOfCall {
 public:
  void add(const double*) {}
};

namespace library_calls {

// From the first call on, crashes and exits of the process are watched.
void watch();

struct Points {
  std::array<const double*, 8> places{};
  int count = 0;
};
void stand_at(const Points* points);  // the points of this thread's calls; nullptr: none

// While it lives, this thread is in the library.
class Inside {
 public:
  explicit Inside(const std::string& file);
  ~Inside();
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

  void takes(int point);  // the library has only this one of the points of the call
};

}  // namespace library_calls

struct UserLaw;

template <>
class PointsOfCall<UserLaw> {
 public:
  PointsOfCall() { library_calls::stand_at(&points_); }
  ~PointsOfCall() { library_calls::stand_at(nullptr); }
  PointsOfCall(const PointsOfCall&) = delete;
  PointsOfCall& operator=(const PointsOfCall&) = delete;

  void add(const double* place) { points_.places[points_.count++] = place; }

 private:
  library_calls::Points points_;
};

}  // namespace strut::materials
