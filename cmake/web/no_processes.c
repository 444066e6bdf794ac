// A page starts no other programs: whoever asks hears that the system cannot.
#include <errno.h>
#include <spawn.h>

int posix_spawnp(pid_t* id, const char* file, const posix_spawn_file_actions_t* actions, const posix_spawnattr_t* how,
                 char* const arguments[], char* const environment[]) {
  (void)id, (void)file, (void)actions, (void)how, (void)arguments, (void)environment;
  return ENOSYS;
}
