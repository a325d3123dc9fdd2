#pragma once

#include <cerrno>

#include <sys/file.h>

#include "base/descriptor.hpp"

namespace springlod::inline base {

/// Locks an open file for this process until its descriptor is closed, at the latest when the
/// process ends, however it ends. Programs started by run_program do not inherit the lock.
/// `operation`: LOCK_EX, or LOCK_EX | LOCK_NB, which does not wait. Returns 0 or the error,
/// EWOULDBLOCK if another one holds the lock. Some file systems have no locks.
inline int lock_file(const Descriptor& file, int operation) {
  while (::flock(file.number(), operation) != 0)
    if (errno != EINTR) return errno;
  return 0;
}

}  // namespace springlod::inline base
