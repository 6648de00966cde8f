"""HiGHS that prints nothing of itself."""

import highspy


class SilentHighs(highspy.Highs):
    """A Highs whose output is off from the start: from 1.16 on it prints its version as soon as it is made."""

    def enableCallbacks(self):  # the first that HiGHS's own __init__ calls
        self.setOptionValue("output_flag", False)
        super().enableCallbacks()
