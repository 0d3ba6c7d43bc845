#include "ros2/dds/cdr_type.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <span>

namespace tern::ros2 {
namespace {

/// The bytes of a sample; empty for an instance's key, as the types have none. They are filled up to whole words, and
/// the last byte of the header says by how many bytes (XTypes 1.3 §7.6.3.1.2).
struct CdrData : ddsi_serdata {
  std::string bytes;
};

CdrData& own(ddsi_serdata* data) { return *static_cast<CdrData*>(data); }
const CdrData& own(const ddsi_serdata* data) { return *static_cast<const CdrData*>(data); }

/// Returns new data, or null if there is no memory: no exception may pass through Cyclone.
template <class Fill>
ddsi_serdata* make_data(const ddsi_sertype* type, ddsi_serdata_kind kind, const Fill& fill) {
  try {
    auto data = std::make_unique<CdrData>();
    fill(data->bytes);
    ddsi_serdata_init(data.get(), type, kind);
    data->hash = type->serdata_basehash;
    return data.release();
  } catch (const std::exception&) {
    return nullptr;
  }
}

ddsi_serdata* from_fragments(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* part, size_t size) {
  return make_data(type, kind, [&](std::string& bytes) {
    bytes.reserve(size);
    for (; part != nullptr; part = part->nextfrag) {
      if (part->maxp1 <= bytes.size()) continue;  // parts may overlap
      const auto* payload = reinterpret_cast<const char*>(NN_RMSG_PAYLOADOFF(part->rmsg, NN_RDATA_PAYLOAD_OFF(part)));
      bytes.append(payload + (bytes.size() - part->min), part->maxp1 - bytes.size());
    }
    bytes.resize(size);
  });
}

ddsi_serdata* from_buffers(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                           const ddsrt_iovec_t* buffers, size_t size) {
  return make_data(type, kind, [&](std::string& bytes) {
    for (const ddsrt_iovec_t& buffer : std::span(buffers, count)) {
      bytes.append(static_cast<const char*>(buffer.iov_base), buffer.iov_len);
    }
    bytes.resize(size);
  });
}

ddsi_serdata* from_keyhash(const ddsi_sertype* type, const ddsi_keyhash*) {
  return make_data(type, SDK_KEY, [](std::string&) {});
}

ddsi_serdata* from_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, const void* sample) {
  return make_data(type, kind, [&](std::string& bytes) {
    if (kind != SDK_DATA) return;
    bytes = *static_cast<const std::string*>(sample);
    constexpr std::size_t kWord = 4, kOptions = 3;
    const std::size_t filled = (kWord - bytes.size() % kWord) % kWord;
    bytes.append(filled, '\0');
    if (bytes.size() > kOptions) bytes[kOptions] = static_cast<char>(filled);
  });
}

bool to_sample(const ddsi_serdata* data, void* sample, void**, void*) {
  *static_cast<std::string*>(sample) = own(data).bytes;
  return true;
}

bool no_key_to_sample(const ddsi_sertype*, const ddsi_serdata*, void* sample, void**, void*) {
  static_cast<std::string*>(sample)->clear();
  return true;
}

/// Cyclone may ask for whole words beyond the end.
void to_bytes(const ddsi_serdata* data, size_t from, size_t size, void* buffer) {
  const std::string& bytes = own(data).bytes;
  const std::size_t there = from < bytes.size() ? std::min(size, bytes.size() - from) : 0;
  std::memset(buffer, 0, size);
  std::memcpy(buffer, bytes.data() + std::min(from, bytes.size()), there);
}

/// Its own samples consist of whole words, and only those are sent.
ddsi_serdata* to_buffer(const ddsi_serdata* data, size_t from, size_t size, ddsrt_iovec_t* buffer) {
  ddsi_serdata* kept = ddsi_serdata_ref(data);
  buffer->iov_base = own(kept).bytes.data() + from;
  buffer->iov_len = static_cast<ddsrt_iov_len_t>(size);
  return kept;
}

void release_buffer(ddsi_serdata* data, const ddsrt_iovec_t*) { ddsi_serdata_unref(data); }

ddsi_serdata* to_untyped(const ddsi_serdata* data) {
  ddsi_serdata* untyped = make_data(data->type, SDK_KEY, [](std::string&) {});
  if (untyped != nullptr) untyped->type = nullptr;
  return untyped;
}

uint32_t size_of(const ddsi_serdata* data) { return static_cast<uint32_t>(own(data).bytes.size()); }
bool equal_keys(const ddsi_serdata*, const ddsi_serdata*) { return true; }
void free_data(ddsi_serdata* data) { delete &own(data); }
void no_keyhash(const ddsi_serdata*, ddsi_keyhash* hash, bool) { std::memset(hash->value, 0, sizeof hash->value); }

size_t print(const ddsi_sertype*, const ddsi_serdata*, char* text, size_t size) {
  if (size > 0) text[0] = '\0';
  return 0;
}

const ddsi_serdata_ops& data_ops() {
  static const ddsi_serdata_ops kOps = [] {
    ddsi_serdata_ops ops{};
    ops.eqkey = equal_keys;
    ops.get_size = size_of;
    ops.from_ser = from_fragments;
    ops.from_ser_iov = from_buffers;
    ops.from_keyhash = from_keyhash;
    ops.from_sample = from_sample;
    ops.to_ser = to_bytes;
    ops.to_ser_ref = to_buffer;
    ops.to_ser_unref = release_buffer;
    ops.to_sample = to_sample;
    ops.to_untyped = to_untyped;
    ops.untyped_to_sample = no_key_to_sample;
    ops.free = free_data;
    ops.print = print;
    ops.get_keyhash = no_keyhash;
    return ops;
  }();
  return kOps;
}

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete type;
}
bool equal_types(const ddsi_sertype*, const ddsi_sertype*) { return true; }  // beyond their names
uint32_t hash_type(const ddsi_sertype*) { return 0; }
void clear_samples(const ddsi_sertype*, void* samples, size_t count) {
  for (std::string& sample : std::span(static_cast<std::string*>(samples), count)) sample.clear();
}

/// Samples stay where they are; their contents are freed when a writer has gone and an empty sample tells it.
void free_contents(const ddsi_sertype*, void** samples, size_t count, dds_free_op_t) {
  for (void* sample : std::span(samples, count)) std::string().swap(*static_cast<std::string*>(sample));
}

/// Samples always belong to the caller, so Cyclone never allocates any. Types have no TypeObject: as in ROS,
/// their names decide whether they match.
const ddsi_sertype_ops& type_ops() {
  static const ddsi_sertype_ops kOps = [] {
    ddsi_sertype_ops ops{};
    ops.version = ddsi_sertype_v0;
    ops.free = free_type;
    ops.zero_samples = clear_samples;
    ops.free_samples = free_contents;
    ops.equal = equal_types;
    ops.hash = hash_type;
    return ops;
  }();
  return kOps;
}

}  // namespace

ddsi_sertype* make_cdr_type(const std::string& name) {
  auto type = std::make_unique<ddsi_sertype>();
  ddsi_sertype_init(type.get(), name.c_str(), &type_ops(), &data_ops(), true);
  type->allowed_data_representation = 1U << DDS_DATA_REPRESENTATION_XCDR1;
  return type.release();
}

}  // namespace tern::ros2
