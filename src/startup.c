/* startup.c -- reads the startup file before the first prompt. */
#include "startup.h"

#include <stdlib.h>
#include <unistd.h>

#include "base/text.h"
#include "signals.h"

static void
find_startup_path(qdot_text *path)
{
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");

    if (config != NULL && config[0] == '/')
        qdot_text_format(path, "%s/qdot/init.lag", config);
    else if (home != NULL && home[0] == '/')
        qdot_text_format(path, "%s/.config/qdot/init.lag", home);
}

void
qdot_startup_read(qdot_session *session)
{
    qdot_text path = {0};

    find_startup_path(&path);
    if (path.n > 0 && !path.failed && access(path.at, F_OK) == 0) {
        qdot_signals_computing();
        (void)qdot_script_run_file(session, path.at);
    }
    qdot_text_clear(&path);
}
