#include "points/partition.hpp"

#include <zoltan_cpp.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"

namespace strut {

namespace {

// One point as it travels; behind it the numbers of its shape, then its joints, where there are any.
struct Parcel {
  std::int64_t id, element_id;
  double position[3];
  double volume, spacing;
  int block;
  std::uint64_t sets;
  bool has_shape, has_joints;
  int joints;
};

Parcel packed(const PointCloud& cloud, std::size_t i) {
  const Vector& X = cloud.positions[i];
  const bool has_joints = !cloud.joints.empty();
  return {cloud.ids[i],       cloud.element_ids[i],
          {X[0], X[1], X[2]}, cloud.volumes[i],
          cloud.spacings[i],  cloud.blocks[i],
          cloud.sets[i],      !cloud.shapes.empty(),
          has_joints,         has_joints ? static_cast<int>(cloud.joints[i].size()) : 0};
}

void append(PointCloud& cloud, const Parcel& parcel) {
  cloud.ids.push_back(parcel.id);
  cloud.element_ids.push_back(parcel.element_id);
  cloud.positions.emplace_back(parcel.position[0], parcel.position[1], parcel.position[2]);
  cloud.volumes.push_back(parcel.volume);
  cloud.spacings.push_back(parcel.spacing);
  cloud.blocks.push_back(parcel.block);
  cloud.sets.push_back(parcel.sets);
}

// Point i of `from`.
void append(PointCloud& cloud, const PointCloud& from, std::size_t i) {
  append(cloud, packed(from, i));
  if (!from.shapes.empty()) cloud.shapes.push_back(from.shapes[i]);
  if (!from.joints.empty()) cloud.joints.push_back(from.joints[i]);
}

// To and from the bytes of a parcel, one thing after the other.
template <class T>
void put(char*& place, const T* values, std::size_t count) {
  std::memcpy(place, values, count * sizeof(T));
  place += count * sizeof(T);
}
template <class T>
void take(const char*& place, T* values, std::size_t count) {
  std::memcpy(values, place, count * sizeof(T));
  place += count * sizeof(T);
}

// What Zoltan's callbacks read and fill.
struct Migration {
  const PointCloud& from;
  const std::vector<double>& costs;
  Vector lengths;
  PointCloud arrived;
};

const PointCloud& cloud_of(void* data) { return static_cast<Migration*>(data)->from; }

int count(void* data, int* error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(cloud_of(data).size());
}

void list(void* data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int weights, float* weight, int* error) {
  const PointCloud& cloud = cloud_of(data);
  const std::vector<double>& costs = static_cast<Migration*>(data)->costs;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    global[i] = static_cast<ZOLTAN_ID_TYPE>(cloud.ids[i]);
    local[i] = static_cast<ZOLTAN_ID_TYPE>(i);
    if (weights == 1) weight[i] = static_cast<float>(costs[i]);
  }
  *error = ZOLTAN_OK;
}

int dimensions(void*, int* error) {
  *error = ZOLTAN_OK;
  return 3;
}

void place(void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, double* position, int* error) {
  Eigen::Map<Vector>{position} = cloud_of(data).positions[*local].cwiseProduct(static_cast<Migration*>(data)->lengths);
  *error = ZOLTAN_OK;
}

int parcel_size(void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int* error) {
  *error = ZOLTAN_OK;
  const Parcel parcel = packed(cloud_of(data), *local);
  return static_cast<int>(sizeof parcel + (parcel.has_shape ? sizeof(ShapeNumbers) : 0) +
                          parcel.joints * sizeof(std::int64_t));
}

void pack(void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int, int, char* buffer, int* error) {
  const PointCloud& cloud = cloud_of(data);
  const Parcel parcel = packed(cloud, *local);
  put(buffer, &parcel, 1);
  if (parcel.has_shape) put(buffer, numbers_of(cloud.shapes[*local]).data(), ShapeNumbers().size());
  if (parcel.has_joints) put(buffer, cloud.joints[*local].data(), parcel.joints);
  *error = ZOLTAN_OK;
}

void unpack(void* data, int, ZOLTAN_ID_PTR, int, char* buffer, int* error) {
  PointCloud& cloud = static_cast<Migration*>(data)->arrived;
  const char* place = buffer;
  Parcel parcel;
  take(place, &parcel, 1);
  append(cloud, parcel);
  if (parcel.has_shape) {
    ShapeNumbers numbers;
    take(place, numbers.data(), numbers.size());
    cloud.shapes.push_back(shape_of(numbers));
  }
  if (parcel.has_joints) {
    std::vector<std::int64_t>& joints = cloud.joints.emplace_back(parcel.joints);
    take(place, joints.data(), joints.size());
  }
  *error = ZOLTAN_OK;
}

void require(int status, const char* what) {
  if (status != ZOLTAN_OK && status != ZOLTAN_WARN) throw Error(std::string("Zoltan failed to ") + what);
}

Zoltan started_zoltan(const Communicator& communicator, Migration& migration) {
  float version = 0;
  require(Zoltan_Initialize(0, nullptr, &version), "start");
  const auto mpi = Teuchos::rcp_dynamic_cast<const Teuchos::MpiComm<int>>(communicator.teuchos());
  Zoltan zoltan(*mpi->getRawMpiComm());
  zoltan.Set_Param("DEBUG_LEVEL", "0");
  zoltan.Set_Param("LB_METHOD", "RCB");
  zoltan.Set_Param("RETURN_LISTS", "EXPORT");
  zoltan.Set_Param("OBJ_WEIGHT_DIM", "1");
  zoltan.Set_Num_Obj_Fn(count, &migration);
  zoltan.Set_Obj_List_Fn(list, &migration);
  zoltan.Set_Num_Geom_Fn(dimensions, &migration);
  zoltan.Set_Geom_Fn(place, &migration);
  zoltan.Set_Obj_Size_Fn(parcel_size, &migration);
  zoltan.Set_Pack_Obj_Fn(pack, &migration);
  zoltan.Set_Unpack_Obj_Fn(unpack, &migration);
  return zoltan;
}

// What holds for all points, but no points.
PointCloud emptied(const PointCloud& cloud) {
  PointCloud result;
  result.at = cloud.at;
  result.joined = cloud.joined;
  result.block_names = cloud.block_names;
  result.set_names = cloud.set_names;
  return result;
}

// In the form in which Zoltan takes what leaves a rank.
struct Exports {
  std::vector<ZOLTAN_ID_TYPE> ids, places;
  std::vector<int> ranks;
};

PointCloud migrated(const PointCloud& cloud, const std::vector<int>& ranks, const Communicator& communicator) {
  const std::vector<double> no_costs;
  Migration migration{cloud, no_costs, Vector::Ones(), emptied(cloud)};
  Exports leaving;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (ranks[i] == communicator.rank()) {
      append(migration.arrived, cloud, i);
      continue;
    }
    leaving.ids.push_back(static_cast<ZOLTAN_ID_TYPE>(cloud.ids[i]));
    leaving.places.push_back(static_cast<ZOLTAN_ID_TYPE>(i));
    leaving.ranks.push_back(ranks[i]);
  }
  Zoltan zoltan = started_zoltan(communicator, migration);
  require(zoltan.Migrate(-1, nullptr, nullptr, nullptr, nullptr, static_cast<int>(leaving.ids.size()),
                         leaving.ids.data(), leaving.places.data(), leaving.ranks.data(), leaving.ranks.data()),
          "move the points");
  return std::move(migration.arrived);
}

// The place of a cell of the 2²¹ cube along Hilbert's curve (Skilling, "Programming the Hilbert curve", 2004).
std::uint64_t hilbert_key(std::array<std::uint32_t, 3> x) {
  constexpr int bits = 21;
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t swap = x[i] & q ? 0 : (x[0] ^ x[i]) & (q - 1);
      x[0] ^= x[i] & q ? q - 1 : swap;
      x[i] ^= swap;
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t gray = 0;
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
    if (x[2] & q) gray ^= q - 1;
  }
  std::uint64_t key = 0;
  for (int bit = bits - 1; bit >= 0; --bit) {
    for (const std::uint32_t coordinate : x) key = key << 1 | ((coordinate ^ gray) >> bit & 1u);
  }
  return key;
}

// The median over the points, m.
double common_spacing(const PointCloud& cloud) {
  std::vector<double> spacings = cloud.spacings;
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return *middle;
}

// The width of the cells of the curve, m: a spacing halved as often as the cube has room for. So the curve goes through
// all points of a cube of two spacings, of four, … before the next one, and points that follow upon each other are
// neighbors in all directions.
double cell_width(const PointCloud& cloud, double size) {
  const double smallest = std::max(size, 1e-300) / ((1 << 21) - 2), spacing = common_spacing(cloud);
  return spacing > smallest ? std::ldexp(spacing, -static_cast<int>(std::log2(spacing / smallest))) : smallest;
}

std::vector<int> along_curve(const PointCloud& cloud) {
  if (cloud.size() == 0) return {};
  Eigen::AlignedBox3d box;
  for (const Vector& X : cloud.positions) box.extend(X);
  const double width = cell_width(cloud, box.sizes().maxCoeff());
  // Half a cell keeps round-off from deciding about the cells of points on a lattice.
  const Vector origin = box.min() - Vector::Constant(0.5 * width);
  std::vector<std::pair<std::uint64_t, std::int64_t>> keys;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector place = (cloud.positions[i] - origin) / width;
    const auto cell = place.cast<std::uint32_t>();
    keys.emplace_back(hilbert_key({cell[0], cell[1], cell[2]}), cloud.ids[i]);
  }
  std::vector<int> order(cloud.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return keys[a] < keys[b]; });
  return order;
}

}  // namespace

std::vector<int> bisected(const PointCloud& cloud, const std::vector<double>& costs, const Vector& lengths,
                          const Communicator& communicator) {
  std::vector<int> ranks(cloud.size(), communicator.rank());
  if (communicator.size() == 1) return ranks;
  Migration migration{cloud, costs, lengths, {}};
  Zoltan zoltan = started_zoltan(communicator, migration);
  int changed, gid_size, lid_size, imports, exports;
  ZOLTAN_ID_PTR import_gids, import_lids, export_gids, export_lids;
  int *import_ranks, *import_parts, *export_ranks, *export_parts;
  require(zoltan.LB_Partition(changed, gid_size, lid_size, imports, import_gids, import_lids, import_ranks,
                              import_parts, exports, export_gids, export_lids, export_ranks, export_parts),
          "partition the points");
  for (int k = 0; k < exports; ++k) ranks[export_lids[k]] = export_ranks[k];
  Zoltan::LB_Free_Part(&import_gids, &import_lids, &import_ranks, &import_parts);
  Zoltan::LB_Free_Part(&export_gids, &export_lids, &export_ranks, &export_parts);
  return ranks;
}

PointCloud moved(const PointCloud& cloud, const std::vector<int>& ranks, const Communicator& communicator) {
  const PointCloud mine = communicator.size() == 1 ? cloud : migrated(cloud, ranks, communicator);
  return reordered(mine, along_curve(mine));
}

PointCloud partitioned(const PointCloud& cloud, const Communicator& communicator, const Cuts& cuts) {
  std::vector<double> costs(cloud.size(), 1);
  for (std::size_t i = 0; i < costs.size() && !cuts.costs.empty(); ++i) costs[i] = cuts.costs[cloud.blocks[i]];
  return moved(cloud, bisected(cloud, costs, cuts.lengths, communicator), communicator);
}

PointCloud reordered(const PointCloud& cloud, const std::vector<int>& order) {
  PointCloud result = emptied(cloud);
  for (const int i : order) append(result, cloud, i);
  return result;
}

}  // namespace strut
