/* SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Counts the frames that a program shows, whatever it is: loaded before it (LD_PRELOAD), this stands
 * in for the call that puts a finished frame on the screen. The count is the 64 bits at the beginning
 * of the file that FRAME_COUNT_FILE names. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

static volatile uint64_t* count;

__attribute__((constructor)) static void open_count(void) {
  const char* const path = getenv("FRAME_COUNT_FILE");
  const int file = path == NULL ? -1 : open(path, O_RDWR);
  if (file < 0) return;
  void* const memory = mmap(NULL, sizeof(*count), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (memory != MAP_FAILED) count = memory;
}

void glXSwapBuffers(void* display, unsigned long drawable) {
  static void (*show)(void*, unsigned long) = NULL;
  if (show == NULL) show = (void (*)(void*, unsigned long))dlsym(RTLD_NEXT, "glXSwapBuffers");
  show(display, drawable);
  if (count != NULL) ++*count;
}
