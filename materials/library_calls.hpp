// If a user library crashes or ends the program, a message names the library's file and the points it was called for.
#pragma once

#include <array>
#include <string>

namespace strut::materials {

// Scope in which this thread calls law L for the points added by their X (three numbers, m). Empty except for UserLaw.
template <class L>
class PointsOfCall {
 public:
  void add(const double*) {}
};

namespace library_calls {

// Installs the handlers of crashes and of exits, once per process.
void watch();

struct Points {
  std::array<const double*, 8> places{};
  int count = 0;
};
void stand_at(const Points* points);  // sets the points of this thread's calls; nullptr: none

// Scope in which this thread runs code of the library; `file` must outlive it.
class Inside {
 public:
  explicit Inside(const std::string& file);
  ~Inside();
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

  void takes(int point);  // the library now computes this point of the call alone
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
