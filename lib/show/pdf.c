/* pdf.c -- prints a page to PDF by a browser without a window. */
#include "show/pdf.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <signal.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/process.h"
#include "base/sink.h"
#include "base/text.h"

extern char **environ;

enum { SECONDS = 60, A_SECOND = 20 };

static int
remove_folder_entry(const char *path, const struct stat *info, int kind, struct FTW *place)
{
    (void)info;
    (void)kind;
    (void)place;
    return remove(path);
}

/* Make a temporary folder in TMPDIR. */
static qdot_status
make_folder(qdot_text *folder)
{
    const char *parent = getenv("TMPDIR");

    qdot_text_format(folder, "%s/qdot-XXXXXX",
                     parent != NULL && parent[0] != '\0' ? parent : P_tmpdir);
    QDOT_TRY(qdot_text_status(folder));
    if (mkdtemp(folder->at) != NULL)
        return QDOT_OK;
    return qdot_fail(QDOT_EIO, "cannot make a folder for temporary files: %s",
                     strerror(errno));
}

/* Start the first browser found, its output discarded, with the default handling of SIGINT. */
static qdot_status
start_browser(char *const arguments[], pid_t *child)
{
    static const char *const names[] = {"chromium", "chromium-browser", "google-chrome",
                                        "chrome"};
    posix_spawn_file_actions_t actions;
    int failed = posix_spawn_file_actions_init(&actions);

    if (failed == 0) {
        failed = posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
        for (int fd = 1; fd <= 2 && failed == 0; fd++)
            failed =
                posix_spawn_file_actions_addopen(&actions, fd, "/dev/null", O_WRONLY, 0);
        for (size_t i = 0;
             i < sizeof names / sizeof *names && (i == 0 || failed == ENOENT); i++)
            if (failed == 0 || failed == ENOENT)
                failed =
                    posix_spawnp(child, names[i], &actions, NULL, arguments, environ);
        posix_spawn_file_actions_destroy(&actions);
    }
    if (failed == 0)
        return QDOT_OK;
    if (failed == ENOENT) {
        (void)qdot_fail(QDOT_EIO,
                        "a report becomes a PDF by Chromium, which is not installed");
        return qdot_hint(
            "`report to \"x.html\"`, which any browser prints; apt install chromium");
    }
    return qdot_fail(QDOT_EIO, "cannot start Chromium: %s", strerror(failed));
}

/* Wait for the browser to end, at most a minute or until Ctrl-C. */
static qdot_status
wait_for_browser(pid_t child)
{
    const struct timespec nap = {0, 1000000000 / A_SECOND};
    int status = 0;

    for (int k = 0; k < SECONDS * A_SECOND; k++) {
        pid_t done = waitpid(child, &status, WNOHANG);
        qdot_status pressed = qdot_interrupt_check();

        if (done == child && pressed == QDOT_OK)
            return status == 0
                       ? QDOT_OK
                       : qdot_fail(QDOT_EIO, "Chromium failed to print the report");
        if (done == child || (done < 0 && errno != EINTR))
            return pressed != QDOT_OK ? pressed
                                      : qdot_fail(QDOT_EIO, "lost contact with Chromium");
        if (pressed != QDOT_OK) {
            kill(child, SIGTERM);
            waitpid(child, &status, 0);
            return pressed;
        }
        nanosleep(&nap, NULL);
    }
    kill(child, SIGTERM);
    waitpid(child, &status, 0);
    return qdot_fail(QDOT_EIO, "Chromium did not print the report within %d s", SECONDS);
}

/* Copy the PDF file that the browser wrote to the path where the report is wanted. */
static qdot_status
copy_report(const char *from, const char *path)
{
    FILE *file = fopen(from, "rbe");
    qdot_text bytes = {0};
    qdot_status status;

    if (file == NULL)
        return qdot_fail(QDOT_EIO, "Chromium wrote no report: %s", strerror(errno));
    status = qdot_text_add_stream(&bytes, file, SIZE_MAX)
                 ? qdot_text_status(&bytes)
                 : qdot_fail(QDOT_EIO, "cannot read what Chromium wrote");
    fclose(file);
    if (status == QDOT_OK)
        status = qdot_sink_write(path, qdot_text_str(&bytes), bytes.n);
    qdot_text_clear(&bytes);
    return status;
}

static qdot_status
print_page_in_folder(const char *folder, const char *path)
{
    qdot_text profile = {0}, output = {0}, page = {0};
    char options[][48] = {"chromium",
                          "--headless",
                          "--disable-gpu",
                          "--no-first-run",
                          "--disable-sync",
                          "--disable-component-update",
                          "--disable-quic",
                          "--no-pdf-header-footer",
                          "--disable-background-networking",
                          "--virtual-time-budget=2000",
                          "--no-sandbox"};
    enum { OPTIONS = sizeof options / sizeof *options };
    char *arguments[OPTIONS + 4];
    size_t n = OPTIONS - (geteuid() != 0); /* leave out the last option (no sandbox) unless run by root */
    qdot_status status;
    pid_t child;

    qdot_text_format(&profile, "--user-data-dir=%s/profile", folder);
    qdot_text_format(&output, "--print-to-pdf=%s/report.pdf", folder);
    qdot_text_format(&page, "file://%s/report.html", folder);
    status = profile.failed || output.failed || page.failed ? QDOT_ENOMEM : QDOT_OK;
    for (size_t i = 0; i < n; i++)
        arguments[i] = options[i];
    arguments[n++] = profile.at;
    arguments[n++] = output.at;
    arguments[n++] = page.at;
    arguments[n] = NULL;
    if (status == QDOT_OK)
        status = start_browser(arguments, &child);
    if (status == QDOT_OK)
        status = wait_for_browser(child);
    if (status == QDOT_OK)
        status = copy_report(strchr(output.at, '=') + 1, path);
    qdot_text_clear(&profile);
    qdot_text_clear(&output);
    qdot_text_clear(&page);
    return status;
}

qdot_status
qdot_pdf_print(const char *page, size_t length, const char *path)
{
    qdot_text folder = {0}, file = {0};
    qdot_status status;
    qdot_error first;

    if (qdot_rank() > 0)
        return QDOT_OK;
    status = make_folder(&folder);
    if (status != QDOT_OK) {
        qdot_text_clear(&folder);
        return status;
    }
    qdot_text_format(&file, "%s/report.html", folder.at);
    status = qdot_text_status(&file);
    if (status == QDOT_OK)
        status = qdot_sink_write(file.at, page, length);
    if (status == QDOT_OK)
        status = print_page_in_folder(folder.at, path);
    first = *qdot_last_error();
    (void)nftw(folder.at, remove_folder_entry, 16, FTW_DEPTH | FTW_PHYS);
    qdot_text_clear(&folder);
    qdot_text_clear(&file);
    return status == QDOT_OK ? QDOT_OK : qdot_fail_again(&first);
}
