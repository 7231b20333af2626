/// A machine with little memory: one allocation by `new` beyond the limit fails, as huge ones do on every machine.
///
/// ROS makes room for as many elements as a damaged message claims to have, and finds out afterwards that they are not
/// there. Where this package does so, std::bad_alloc ends the fuzz target, which says how much was asked for.

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

namespace {

/// More than the tables of libFuzzer (17 MB in one piece), and far more than any input of the corpus needs.
constexpr std::size_t kLimit_bytes = std::size_t{32} << 20U;

std::atomic<std::size_t> refused_bytes{0};

void* allocateOrNull(std::size_t size) noexcept {
  if (size > kLimit_bytes) {
    refused_bytes = size;
    return nullptr;
  }
  return std::malloc(size);
}

/// Says what was asked for when nobody has caught the refusal.
const std::terminate_handler default_handler = std::set_terminate([] {
  try {
    if (const std::exception_ptr cause = std::current_exception()) {
      std::rethrow_exception(cause);
    }
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "refused to allocate %zu bytes, of %zu allowed\n", refused_bytes.load(), kLimit_bytes);
  } catch (...) {
  }
  default_handler();
});

}  // namespace

#include "replaced_new.h"
