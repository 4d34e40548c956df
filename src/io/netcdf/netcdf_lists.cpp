#include "io/netcdf/netcdf_lists.hpp"

#include <netcdf.h>

#include <cstring>
#include <utility>

#include "base/errors.hpp"

namespace strut::io {

static_assert(sizeof(long long) == sizeof(std::int64_t));  // the library's type

NetcdfLists::NetcdfLists(std::filesystem::path path) : path_(std::move(path)) {}

NetcdfLists NetcdfLists::create(const std::filesystem::path& path) {
  NetcdfLists file(path);
  file.check(nc_create(path.c_str(), NC_64BIT_DATA | NC_CLOBBER, &file.handle_), "create it");
  nc_set_fill(file.handle_, NC_NOFILL, nullptr);
  return file;
}

NetcdfLists NetcdfLists::open(const std::filesystem::path& path) {
  NetcdfLists file(path);
  file.check(nc_open(path.c_str(), NC_NOWRITE, &file.handle_), "open it");
  return file;
}

NetcdfLists::~NetcdfLists() {
  if (handle_ >= 0) nc_abort(handle_);
}

NetcdfLists::NetcdfLists(NetcdfLists&& other) noexcept
    : path_(std::move(other.path_)), handle_(std::exchange(other.handle_, -1)) {}

void NetcdfLists::close() { check(nc_close(std::exchange(handle_, -1)), "close it"); }

// Positive codes are those of the system.
void NetcdfLists::check(int code, const std::string& doing) const {
  if (code == NC_NOERR) return;
  throw Error(path_.string() + ": cannot " + doing + ": " + (code > 0 ? std::strerror(code) : nc_strerror(code)));
}

int NetcdfLists::variable(const std::string& name) const {
  int number = 0;
  check(nc_inq_varid(handle_, name.c_str(), &number), "find '" + name + "' in it");
  return number;
}

// ---- writing

void NetcdfLists::put(const std::string& name, double number) const {
  check(nc_put_att_double(handle_, NC_GLOBAL, name.c_str(), NC_DOUBLE, 1, &number), "write '" + name + "'");
}

void NetcdfLists::put(const std::string& name, const std::string& text) const {
  check(nc_put_att_text(handle_, NC_GLOBAL, name.c_str(), text.size(), text.c_str()), "write '" + name + "'");
}

void NetcdfLists::define(const std::string& name, Of kind, std::size_t size) const {
  if (size == 0) return;  // size 0 would mean unlimited
  int dimension = 0, variable = 0;
  check(nc_def_dim(handle_, ("of_" + name).c_str(), size, &dimension), "define '" + name + "'");
  const nc_type type = kind == Of::reals ? NC_DOUBLE : NC_INT64;
  check(nc_def_var(handle_, name.c_str(), type, 1, &dimension, &variable), "define '" + name + "'");
}

void NetcdfLists::end_definitions() const { check(nc_enddef(handle_), "write its header"); }

void NetcdfLists::put(const std::string& name, std::span<const double> values, std::int64_t begin) const {
  if (values.empty()) return;
  const auto first = static_cast<std::size_t>(begin), count = values.size();
  check(nc_put_vara_double(handle_, variable(name), &first, &count, values.data()), "write '" + name + "'");
}

void NetcdfLists::put(const std::string& name, std::span<const std::int64_t> values, std::int64_t begin) const {
  if (values.empty()) return;
  const auto first = static_cast<std::size_t>(begin), count = values.size();
  const auto* numbers = reinterpret_cast<const long long*>(values.data());
  check(nc_put_vara_longlong(handle_, variable(name), &first, &count, numbers), "write '" + name + "'");
}

// ---- reading

double NetcdfLists::number(const std::string& name) const {
  double value = 0;
  std::size_t length = 0;
  check(nc_inq_attlen(handle_, NC_GLOBAL, name.c_str(), &length), "find '" + name + "' in it");
  if (length != 1) throw Error(path_.string() + ": is damaged: '" + name + "' is not one number");
  check(nc_get_att_double(handle_, NC_GLOBAL, name.c_str(), &value), "read '" + name + "'");
  return value;
}

std::string NetcdfLists::text(const std::string& name) const {
  std::size_t length = 0;
  check(nc_inq_attlen(handle_, NC_GLOBAL, name.c_str(), &length), "find '" + name + "' in it");
  std::string text(length, '\0');
  check(nc_get_att_text(handle_, NC_GLOBAL, name.c_str(), text.data()), "read '" + name + "'");
  return text;
}

std::vector<double> NetcdfLists::reals(const std::string& name) const {
  std::vector<double> values(size(name));
  get(name, values, 0);
  return values;
}

void NetcdfLists::get(const std::string& name, std::span<double> values, std::int64_t begin) const {
  if (values.empty()) return;
  const auto first = static_cast<std::size_t>(begin), count = values.size();
  check(nc_get_vara_double(handle_, variable(name), &first, &count, values.data()), "read '" + name + "'");
}

void NetcdfLists::get(const std::string& name, std::span<std::int64_t> values, std::int64_t begin) const {
  if (values.empty()) return;
  const auto first = static_cast<std::size_t>(begin), count = values.size();
  auto* numbers = reinterpret_cast<long long*>(values.data());
  check(nc_get_vara_longlong(handle_, variable(name), &first, &count, numbers), "read '" + name + "'");
}

bool NetcdfLists::has_number(const std::string& name) const {
  return nc_inq_attid(handle_, NC_GLOBAL, name.c_str(), nullptr) == NC_NOERR;
}

std::size_t NetcdfLists::size(const std::string& name) const {
  int number = 0, dimension = 0, rank = 0;
  std::size_t size = 0;
  if (nc_inq_varid(handle_, name.c_str(), &number) != NC_NOERR) return 0;
  check(nc_inq_varndims(handle_, number, &rank), "read the size of '" + name + "'");
  if (rank != 1) throw Error(path_.string() + ": is damaged: '" + name + "' is not a list");
  check(nc_inq_vardimid(handle_, number, &dimension), "read the size of '" + name + "'");
  check(nc_inq_dimlen(handle_, dimension, &size), "read the size of '" + name + "'");
  return size;
}

}  // namespace strut::io
