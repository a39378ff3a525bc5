/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Children by fork and execve. The time limit is one of processor time (RLIMIT_CPU), so that a child on a
 * busy machine is not taken for one that hangs; and of twenty times as much by the clock (alarm), for one that
 * waits for ever. Both survive execve: the kernel keeps them, even if the child hangs in a loop of its own.
 *
 * gmsh orders some of its work by the addresses of its objects. So that a region is filled the same
 * way every time, a child starts with an empty environment (no MALLOC_... or LD_PRELOAD), without
 * random addresses, and from a path that is the same everywhere.
 */
#include "base/child.h"

#include "base/error.h"
#include "base/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/personality.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/** The exit status by which a child that could not become the program says so. */
enum { NOT_STARTED = 127 };

/** By the clock a child may take so many times its limit of processor time. */
enum { BUSY = 20 };

static FILE *file_in_memory(void) {
    int descriptor = memfd_create("kirsch", MFD_CLOEXEC);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "w+");
    if (!file)
        kr_stop(KR_EXIT_MEMORY, "no file in memory can be made: %s", strerror(errno));
    return file;
}

double kr_child_clock(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void kr_child_prepare(struct kr_child *child) {
    *child = (struct kr_child){0, file_in_memory(), file_in_memory(), file_in_memory(), 0};
}

/** In the child: what is to run, and in which way. */
struct program {
    char *const *word, *const *environment;
    char *const *argument; /* of a copy: its name, its arguments */
    int in_memory; /* from a copy, at the root of the file system */
    int folder;    /* and this open folder as KR_CHILD_FOLDER; 0: none */
};

/** Run a copy of the program in memory, which has the same path everywhere. */
static void run_copy(const struct program *program) {
    enum { COPY = 3, FOLDER = 4, APART = 16 };
    char part[1 << 16];
    ssize_t n;
    int folder = program->folder ? fcntl(program->folder, F_DUPFD_CLOEXEC, APART) : 0;
    int from = open(program->word[0], O_RDONLY | O_CLOEXEC), to = memfd_create("kirsch", 0);
    if (from < 0 || to < 0 || folder < 0)
        return;
    while ((n = read(from, part, sizeof part)) > 0)
        if (write(to, part, (size_t)n) != n)
            return;
    if (n == 0 && chdir("/") == 0 && dup2(to, COPY) == COPY && (!folder || dup2(folder, FOLDER) == FOLDER))
        execve("/proc/self/fd/3", program->argument, program->environment);
}

/** In the child: only calls that are safe between fork and exec. */
_Noreturn static void become(const struct program *program, const int file[3], unsigned seconds,
                             pid_t parent) {
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    signal(SIGALRM, SIG_DFL);
    signal(SIGXCPU, SIG_DFL);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
        _exit(NOT_STARTED); /* the parent ended before it could be watched */
    if (seconds) {
        setrlimit(RLIMIT_CPU, &(struct rlimit){seconds, RLIM_INFINITY});
        alarm(BUSY * seconds);
    }
    for (int k = 0; k < 3; k++)
        if (dup2(file[k], k) < 0)
            _exit(NOT_STARTED);
    personality(ADDR_NO_RANDOMIZE); /* where this is forbidden, nothing is lost but certainty */
    if (program->in_memory)
        run_copy(program);
    else
        execve(program->word[0], program->word, program->environment);
    _exit(NOT_STARTED);
}

static void launch(struct kr_child *child, struct program program, unsigned seconds) {
    int file[3] = {fileno(child->in), fileno(child->out), fileno(child->said)};
    pid_t parent = getpid();
    fflush(NULL);
    rewind(child->in);
    /* dup2 onto itself would keep the close-on-exec mark; files in memory stand above 0, 1, 2
     * unless this program was started with those closed. */
    for (int k = 0; k < 3; k++)
        if (file[k] < 3)
            kr_stop(KR_EXIT_LIBRARY, "standard input, output or error is closed");
    child->started = kr_child_clock();
    child->pid = fork();
    if (child->pid < 0)
        kr_stop(KR_EXIT_LIBRARY, "%s cannot be started: %s", program.word[0], strerror(errno));
    if (child->pid == 0)
        become(&program, file, seconds, parent);
}

/** With no environment but the place of libraries. */
static void launch_bare(struct kr_child *child, struct program program, unsigned seconds) {
    const char *libraries = getenv("LD_LIBRARY_PATH");
    char *kept = libraries ? kr_text("LD_LIBRARY_PATH=%s", libraries) : NULL;
    program.environment = (char *[]){kept, NULL};
    launch(child, program, seconds);
    kr_free(kept);
}

void kr_child_start(struct kr_child *child, const char *program, unsigned seconds) {
    char *word[] = {(char *)(uintptr_t)program, NULL}, *argument[] = {"kirsch", NULL};
    launch_bare(child, (struct program){.word = word, .argument = argument, .in_memory = 1}, seconds);
}

void kr_child_start_on(struct kr_child *child, const char *program, char *const *argument, const char *from,
                       const char *folder, unsigned seconds) {
    char *word[] = {(char *)(uintptr_t)program, NULL};
    struct program copy = {.word = word, .argument = argument, .in_memory = 1};
    FILE *file = fopen(from, "rb");
    if (!file)
        kr_stop(KR_EXIT_INPUT, "%s cannot be read: %s", from, strerror(errno));
    fclose(child->in);
    child->in = file;
    if (folder && (copy.folder = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC)) < 0)
        kr_stop(KR_EXIT_STORAGE, "%s cannot be opened: %s", folder, strerror(errno));
    launch_bare(child, copy, seconds);
    if (copy.folder)
        close(copy.folder);
}

void kr_child_start_words(struct kr_child *child, char *const *word, unsigned seconds) {
    launch_bare(child, (struct program){.word = word}, seconds);
}

void kr_child_start_in(struct kr_child *child, char *const *word, char *const *environment,
                       unsigned seconds) {
    launch(child, (struct program){.word = word, .environment = environment}, seconds);
}

pid_t kr_child_wait(int *status) {
    pid_t pid;
    do
        pid = waitpid(-1, status, 0);
    while (pid < 0 && errno == EINTR);
    if (pid < 0)
        kr_stop(KR_EXIT_LIBRARY, "waiting for a child failed: %s", strerror(errno));
    return pid;
}

char *kr_child_trouble(int status, unsigned seconds) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        return kr_text("it was not done after %u s of work", seconds);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
        return kr_text("it was not done after %u s", BUSY * seconds);
    if (WIFSIGNALED(status))
        return kr_text("it crashed (%s)", strsignal(WTERMSIG(status)));
    if (WIFEXITED(status) && WEXITSTATUS(status) == NOT_STARTED)
        return kr_text("it could not be started");
    if (WIFEXITED(status) && WEXITSTATUS(status) != 0)
        return kr_text("it ended with exit code %d", WEXITSTATUS(status));
    return NULL;
}

char *kr_child_line(struct kr_child *child, const char *word) {
    char *line = NULL, *found = NULL;
    size_t room = 0;
    ssize_t length;
    rewind(child->said);
    while (!found && (length = getline(&line, &room, child->said)) >= 0)
        if (strstr(line, word)) {
            line[strcspn(line, "\n")] = 0;
            found = kr_text_copy(line);
        }
    free(line);
    return found;
}

void kr_child_close(struct kr_child *child) {
    fclose(child->in);
    fclose(child->out);
    fclose(child->said);
}

/** Folder of this program, into `self`. */
static void own_folder(char *self, size_t room) {
    ssize_t length = readlink("/proc/self/exe", self, room - 1);
    if (length <= 0)
        kr_stop(KR_EXIT_LIBRARY, "/proc/self/exe cannot be read: %s", strerror(errno));
    self[length] = 0;
    *strrchr(self, '/') = 0;
}

char *kr_child_script(const char *name) {
    char self[4096];
    own_folder(self, sizeof self);
    char *beside = kr_text("%s/%s", self, name);
    char *installed = kr_text("%s/../share/kirsch/%s", self, name);
    if (access(beside, R_OK) == 0) {
        kr_free(installed);
        return beside;
    }
    if (access(installed, R_OK))
        kr_stop(KR_EXIT_LIBRARY,
                "%s is missing: it lies neither at %s nor at %s; run make or make install again",
                name, beside, installed);
    kr_free(beside);
    return installed;
}

char *kr_child_beside(const char *name) {
    char self[4096];
    own_folder(self, sizeof self);
    char *path = kr_text("%s/%s", self, name);
    if (access(path, X_OK))
        kr_stop(KR_EXIT_LIBRARY, "the program %s is missing: it should stand at %s", name, path);
    return path;
}
