/// @file
/// Drivers of HDF5's virtual file layer, which defines how bytes are written to a file and read from it. Internal:
/// includes hdf5.h, not for users of the library.
#pragma once

#include "solvers/hdf5/detail/storage.hpp"

#include <cstddef>
#include <mutex>

namespace cardan::solvers::detail {

/// Features that both drivers leave to HDF5: gathering small pieces. Their files are plain files.
inline herr_t query_features(const H5FD_t*, unsigned long* flags) noexcept {
    if (flags != nullptr) {
        *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
                 H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    }
    return 0;
}

/// Identifier of a driver: a class of static functions that are called by the C library and let no exception out.
/// Registered with that library at first use, and again should the host program have closed the library since.
template <class Driver>
hid_t registered() {
    static std::mutex mutex;
    static hid_t id = -1;
    const std::lock_guard lock(mutex);
    if (id < 0 || H5Iget_type(id) != H5I_VFL) {
        H5FD_class_t table{};  // zeros: no driver block in the file, one free list for each kind of data
        table.name = Driver::driver_name;
        table.maxaddr = Driver::max_address;
        table.fc_degree = H5F_CLOSE_WEAK;
        table.fapl_size = sizeof(typename Driver::Access);
        table.open = Driver::open;
        table.close = Driver::close;
        table.cmp = Driver::compare;
        table.query = query_features;
        table.get_eoa = Driver::end_allocated;
        table.set_eoa = Driver::set_end_allocated;
        table.get_eof = Driver::end_of_file;
        table.read = Driver::read;
        table.write = Driver::write;
        table.truncate = Driver::truncate;
        id = H5FDregister(&table);
    }
    return id;
}

/// Limits HDF5's cache of metadata, which by itself grows from 2 to 32 MiB and would let a long run take more memory
/// the longer it gets. With 64 KiB none is seen over 4e6 steps.
inline bool limit_metadata_cache(hid_t access_list) {
    constexpr std::size_t max = 65536;  // bytes
    H5AC_cache_config_t config{};
    config.version = H5AC__CURR_CACHE_CONFIG_VERSION;
    if (H5Pget_mdc_config(access_list, &config) < 0) return false;
    config.set_initial_size = true;
    config.initial_size = max;
    config.max_size = max;
    config.min_size = max / 2;
    return H5Pset_mdc_config(access_list, &config) >= 0;
}

/// File access list that carries `access` to Driver::open(). Its files have the format of HDF5 1.8.
template <class Driver>
Handle access_through(const typename Driver::Access& access) {
    Handle list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    if (list.valid() &&
        (H5Pset_driver(list.get(), registered<Driver>(), &access) < 0 ||
         H5Pset_libver_bounds(list.get(), H5F_LIBVER_V18, H5F_LIBVER_V18) < 0 || !limit_metadata_cache(list.get())))
        list.close();
    return list;
}

}  // namespace cardan::solvers::detail
