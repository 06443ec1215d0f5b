// SPDX-License-Identifier: GPL-2.0-or-later
#include "client/gateway/hal/shared_memory.h"

#include <errno.h>
#include <fcntl.h>
#include <grp.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum { mode = 0660, longest_name = 31 };

static const char *const allowed = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

// Removes what is there under that name, unless somebody owns it.
static const char *clear_away(const char *path) {
  const int file = shm_open(path, O_RDWR, 0);
  if (file < 0) return errno == ENOENT ? NULL : strerror(errno);
  const bool owned = flock(file, LOCK_EX | LOCK_NB) != 0;
  close(file);
  if (owned) return "another kcs_player has it: unload that one, or choose another name";
  return shm_unlink(path) == 0 || errno == ENOENT ? NULL : strerror(errno);
}

static const char *give_to(int file, const char *group) {
  if (*group != '\0') {
    const struct group *entry = getgrnam(group);
    if (!entry) return "there is no such group";
    if (fchown(file, (uid_t)-1, entry->gr_gid) != 0) return "whoever runs LinuxCNC must belong to the group";
  }
  return fchmod(file, mode) == 0 ? NULL : strerror(errno);
}

// Makes it as large as needed, in memory and not only promised.
static const char *map(struct kcs_shared_memory *shared) {
  const off_t size = sizeof *shared->memory;
  const int fault = posix_fallocate(shared->file, 0, size);
  if (fault != 0) return strerror(fault);
  void *memory = mmap(NULL, (size_t)size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, shared->file, 0);
  if (memory == MAP_FAILED) return strerror(errno);
  shared->memory = memory;
  return NULL;
}

const char *kcs_open_shared_memory(struct kcs_shared_memory *shared, const char *name, const char *group) {
  const size_t length = strlen(name);
  if (length == 0 || length > longest_name || strspn(name, allowed) != length) {
    return "a name has 1 to 31 letters, digits, - and _";
  }
  snprintf(shared->name, sizeof shared->name, "/kcs-%s", name);
  const char *reason = clear_away(shared->name);
  if (reason) return reason;
  shared->file = shm_open(shared->name, O_RDWR | O_CREAT | O_EXCL, 0);
  if (shared->file < 0) return strerror(errno);
  if (flock(shared->file, LOCK_EX | LOCK_NB) != 0) reason = strerror(errno);
  if (!reason) reason = map(shared);
  if (!reason) reason = give_to(shared->file, group);
  if (reason) {
    shm_unlink(shared->name);
    close(shared->file);
  }
  return reason;
}

void kcs_close_shared_memory(struct kcs_shared_memory *shared) {
  shm_unlink(shared->name);
  munmap(shared->memory, sizeof *shared->memory);
  close(shared->file);
}
