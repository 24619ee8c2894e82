/* own-folder.h -- a temporary folder that a program of tests works in, and removes with what it wrote there.
 *
 *     cmocka_run_group_tests(tests, own_folder_enter, own_folder_leave)
 */
#ifndef TESTS_OWN_FOLDER_H
#define TESTS_OWN_FOLDER_H

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char own_folder[] = P_tmpdir "/qdot-test-XXXXXX";

static inline int
own_folder_enter(void **state)
{
    (void)state;
    return mkdtemp(own_folder) == NULL || chdir(own_folder) != 0;
}

/* Remove all files of the current folder; how many there were, not counting `but` (NULL: all count). */
static inline int
own_folder_clean(const char *but)
{
    DIR *all = opendir(".");
    int n = 0;

    assert_non_null(all);
    for (struct dirent *e = readdir(all); e != NULL; e = readdir(all))
        if (strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0) {
            n += but == NULL || strcmp(e->d_name, but) != 0;
            (void)unlink(e->d_name);
        }
    closedir(all);
    return n;
}

static inline int
own_folder_leave(void **state)
{
    (void)state;
    (void)own_folder_clean(NULL);
    return chdir("/") != 0 || rmdir(own_folder) != 0;
}

#endif
