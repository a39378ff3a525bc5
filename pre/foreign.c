/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Meshes in any format. See foreign.h.
 */
#include "foreign.h"

#include "base/child.h"
#include "base/error.h"
#include "base/memory.h"
#include "cad.h"

#include <ctype.h>
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

/* Not the first `python3` on PATH: that may be one which does not see Debian's packages. */
#define PYTHON "/usr/bin/python3"

/* Long enough for 10 million cells, short enough that a hang is noticed. */
enum { SECONDS = 3600 };

/** What Python lacks, if this line of a child's is the last of a trace that an import ended with: a sentence owned by
 * the caller; else NULL. Debian's packages are named after their modules. */
static char *what_is_missing(const char *line) {
    char module[64], package[64];
    size_t k = 0;
    if (!strncmp(line, "ImportError: ", 13))
        return kr_text("Python cannot load what reads or writes this format: %s", line + 13);
    if (sscanf(line, "ModuleNotFoundError: No module named '%63[^'.]", module) != 1)
        return NULL;
    do
        package[k] = (char)tolower((unsigned char)module[k]);
    while (module[k++]);
    return kr_text("this format needs Python's module %s, which is missing; on Debian: apt-get install python3-%s",
                   module, package);
}

/** Pass on what a child noted; returns its error, owned by the caller, or NULL, and of which kind it is. */
static char *listen(struct kr_child *child, enum kr_exit *code) {
    char *line = NULL, *error = NULL;
    size_t room = 0;
    *code = KR_EXIT_INPUT;
    rewind(child->said);
    while (!error && getline(&line, &room, child->said) >= 0) {
        line[strcspn(line, "\n")] = 0;
        if (!strncmp(line, "Note: ", 6))
            kr_warn("%s", line + 6);
        else if (!strncmp(line, "Warning", 7) && strstr(line, ": "))
            kr_warn("%s", strstr(line, ": ") + 2);
        else if (!strncmp(line, "Error", 5) && strstr(line, ": "))
            error = kr_text_copy(strstr(line, ": ") + 2);
        else if ((error = what_is_missing(line)))
            *code = KR_EXIT_LIBRARY;
    }
    free(line);
    return error;
}

/** Wait for a program's end; what went wrong stops and names the file that it was about. */
static void finish(struct kr_child *child, const char *program, const char *about) {
    enum kr_exit code;
    int status;
    kr_child_wait(&status);
    char *error = listen(child, &code), *trouble = kr_child_trouble(status, SECONDS);
    kr_child_close(child);
    if (error)
        kr_stop(code, "%s: %s", about, error);
    if (trouble)
        kr_stop(KR_EXIT_LIBRARY, "%s: %s was to read it, and %s", about, program, trouble);
}

void kr_python(const char *script, const char *from, const char *to, const char *about) {
    char *path = kr_child_script(script);
    if (access(PYTHON, X_OK))
        kr_stop(KR_EXIT_LIBRARY,
                "%s: this format needs " PYTHON "; on Debian: apt-get install python3 python3-meshio "
                "python3-netcdf4 python3-h5py",
                about);
    char *word[] = {PYTHON, "-B", path, (char *)(uintptr_t)from, (char *)(uintptr_t)to, NULL};
    struct kr_child child;
    kr_child_prepare(&child);
    kr_child_start_words(&child, word, SECONDS);
    finish(&child, PYTHON, about);
    kr_free(path);
}

/** gmsh meshes a body of CAD with cells of the length `spacing`. */
static void mesh_geometry(const char *from, const char *folder, const char *to, double spacing) {
    if (!(spacing > 0))
        kr_stop(KR_EXIT_INPUT, "%s: a body without a mesh needs the length of a cell; give a deck "
                               "with mesh.spacing", from);
    char *program = kr_child_beside("kirsch-gmsh"), *size = kr_text("%.17g", spacing);
    char *argument[] = {"kirsch", "--body", (char *)(uintptr_t)kr_cad_format(from), size, NULL};
    char *made = kr_text("%s%s", folder, strrchr(KR_GMSH_BODY, '/'));
    struct kr_child child;
    kr_child_prepare(&child);
    kr_child_start_on(&child, program, argument, from, folder, SECONDS);
    finish(&child, program, from);
    if (rename(made, to))
        kr_stop(KR_EXIT_STORAGE, "%s cannot be written: %s", to, strerror(errno));
    kr_free(made);
    kr_free(program);
    kr_free(size);
}

/** Whether a file begins with these bytes. Stops where it cannot be read. */
static int begins_with(const char *path, const char *begin) {
    char head[16] = {0};
    FILE *file = fopen(path, "rb");
    if (!file)
        kr_stop(KR_EXIT_INPUT, "%s cannot be read: %s", path, strerror(errno));
    size_t got = fread(head, 1, sizeof head, file);
    fclose(file);
    return got >= strlen(begin) && !memcmp(head, begin, strlen(begin));
}

static int has_ending(const char *path, const char *endings) {
    const char *dot = strrchr(path, '.');
    size_t length = dot ? strlen(dot + 1) : 0;
    while (length && *endings) {
        size_t n = strcspn(endings, " ");
        if (n == length && !strncasecmp(dot + 1, endings, n))
            return 1;
        endings += n + (endings[n] == ' ');
    }
    return 0;
}

/** FOLDER/NAME.converted.ENDING for the file PATH/NAME.EXTENSION. */
static char *converted_name(const char *path, const char *folder, const char *ending) {
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    return kr_text("%s/%.*s.converted.%s", folder, (int)(dot ? dot - name : (long)strlen(name)),
                   name, ending);
}

struct kr_mesh *kr_mesh_read(const char *path, const char *folder, double spacing, char **points) {
    int is_msh = has_ending(path, "msh") && !begins_with(path, "(");
    *points = NULL;
    if (is_msh || begins_with(path, "$MeshFormat"))
        return kr_mesh_read_msh(path);
    char *beside = converted_name(path, folder, "part.msh");
    if (kr_cad_format(path))
        mesh_geometry(path, folder, beside, spacing);
    else
        kr_python("to_msh.py", path, beside, path);
    int is_table = begins_with(beside, "x,y,z,volume");
    char *made = converted_name(path, folder, is_table ? "csv" : "msh");
    if (rename(beside, made))
        kr_stop(KR_EXIT_STORAGE, "%s cannot be written: %s", made, strerror(errno));
    kr_free(beside);
    if (is_table) {
        *points = made;
        return NULL;
    }
    struct kr_mesh *mesh = kr_mesh_read_msh(made);
    kr_free(made);
    return mesh;
}
