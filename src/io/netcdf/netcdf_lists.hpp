// A netCDF file with named numbers, texts and lists of numbers. Serial.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace strut::io {

// Uses the classic model with 64-bit sizes: it is simple, and incomplete files can be recognized. Every call throws
// Error with the file, the operation and the cause. An empty list is not stored, and reads back as empty.
class NetcdfLists {
 public:
  static NetcdfLists create(const std::filesystem::path& path);
  // `path`: complete (classic_netcdf.hpp) and not HDF5, on which the library might crash.
  static NetcdfLists open(const std::filesystem::path& path);
  ~NetcdfLists();
  NetcdfLists(NetcdfLists&& other) noexcept;
  NetcdfLists& operator=(NetcdfLists&&) = delete;

  // First numbers, texts and the sizes of lists, then their values, or some of them from number `begin` on.
  void put(const std::string& name, double number) const;
  void put(const std::string& name, const std::string& text) const;
  enum class Of { reals, integers };
  void define(const std::string& name, Of kind, std::size_t size) const;
  void end_definitions() const;
  void put(const std::string& name, std::span<const double> values, std::int64_t begin = 0) const;
  void put(const std::string& name, std::span<const std::int64_t> values, std::int64_t begin = 0) const;
  void close();

  double number(const std::string& name) const;
  std::string text(const std::string& name) const;
  std::vector<double> reals(const std::string& name) const;
  // Fills the span with values from number `begin` on.
  void get(const std::string& name, std::span<double> values, std::int64_t begin) const;
  void get(const std::string& name, std::span<std::int64_t> values, std::int64_t begin) const;
  bool has_number(const std::string& name) const;
  std::size_t size(const std::string& name) const;  // of a list; 0 if there is none

 private:
  explicit NetcdfLists(std::filesystem::path path);
  int variable(const std::string& name) const;
  void check(int code, const std::string& doing) const;

  std::filesystem::path path_;
  int handle_ = -1;
};

}  // namespace strut::io
