//! A child process that is asked in lines and answers in lines.
//!
//! ```text
//!  ask ──▶ [writer] ──▶ stdin of `sh -c COMMAND` ──▶ stdout ──▶ [reader] ──▶ answer, at most LIMIT later
//! ```
//!
//! Two threads keep a program that reads nothing, or writes no end, from stopping us: the writer waits where it must,
//! the reader holds at most one line in hand and one in the channel, each of a bounded length. The child runs in a
//! process group of its own, so that what a shell started ends with it. Its standard error is ours. Left out: systems
//! without `sh`; there, starting fails.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TryRecvError, sync_channel};
use std::thread;
use std::time::Duration;

/// Bytes after which a line is taken as it is; what is cut off cannot be JSON any more.
const LONGEST_LINE: u64 = 1 << 16;

/// How long a program that has closed its output is given to end, so that its exit status can be told.
const ENDING: Duration = Duration::from_millis(200);

/// A running program.
pub(super) struct Program {
    child: Child,
    reaped: bool,
    questions: SyncSender<Vec<u8>>,
    answers: Receiver<Vec<u8>>,
}

/// What came instead of an answer.
pub(super) enum NoAnswer {
    /// Nothing, for as long as we waited.
    Silent,
    /// A line before the question.
    Unasked(Vec<u8>),
    /// The end of its output, and its exit status if it has ended, too.
    Ended(Option<ExitStatus>),
}

impl Program {
    /// Starts `sh -c command`.
    pub(super) fn start(command: &str) -> io::Result<Self> {
        let mut shell = Command::new("sh");
        shell.args(["-c", command]);
        shell.stdin(Stdio::piped()).stdout(Stdio::piped());
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut shell, 0);
        let mut child = shell.spawn()?;
        let (questions, to_write) = sync_channel(1);
        let (heard, answers) = sync_channel(1);
        if let Some(input) = child.stdin.take() {
            thread::spawn(move || write(input, &to_write));
        }
        if let Some(output) = child.stdout.take() {
            thread::spawn(move || listen(output, &heard));
        }
        Ok(Self {
            child,
            reaped: false,
            questions,
            answers,
        })
    }

    /// Asks a question and waits for its answer, for `limit` at most.
    pub(super) fn ask(&mut self, question: Vec<u8>, limit: Duration) -> Result<Vec<u8>, NoAnswer> {
        match self.answers.try_recv() {
            Ok(line) => return Err(NoAnswer::Unasked(line)),
            Err(TryRecvError::Disconnected) => return Err(NoAnswer::Ended(self.ending())),
            Err(TryRecvError::Empty) => {}
        }
        // Refused where the writer has given up, or still has the last question: then the answer tells, or its lack.
        let _unread = self.questions.try_send(question);
        match self.answers.recv_timeout(limit) {
            Ok(line) => Ok(line),
            Err(RecvTimeoutError::Timeout) => Err(NoAnswer::Silent),
            Err(RecvTimeoutError::Disconnected) => Err(NoAnswer::Ended(self.ending())),
        }
    }

    fn ending(&mut self) -> Option<ExitStatus> {
        let step = ENDING / 20;
        for _ in 0..20 {
            if let Ok(Some(status)) = self.child.try_wait() {
                self.reaped = true;
                return Some(status);
            }
            thread::sleep(step);
        }
        None
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // The group first, while its leader has not been waited for: until then its number belongs to nobody else.
        // Safe code has no call for it, every `sh` does. Nobody can be told where ending it fails.
        if !self.reaped {
            #[cfg(unix)]
            let _group = Command::new("sh")
                .args([
                    "-c",
                    r#"kill -s KILL -- "-$0""#,
                    &self.child.id().to_string(),
                ])
                .stdin(Stdio::null())
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .status();
            let _killed = self.child.kill();
            let _status = self.child.wait();
        }
    }
}

/// Passes questions on until the program or its owner is gone.
fn write(mut input: ChildStdin, questions: &Receiver<Vec<u8>>) {
    for question in questions {
        if input
            .write_all(&question)
            .and_then(|()| input.flush())
            .is_err()
        {
            return;
        }
    }
}

/// Passes lines on until there are none, or nobody wants them.
fn listen(output: ChildStdout, heard: &SyncSender<Vec<u8>>) {
    let mut output = BufReader::new(output);
    loop {
        let mut line = Vec::new();
        let read = output
            .by_ref()
            .take(LONGEST_LINE)
            .read_until(b'\n', &mut line);
        if !matches!(read, Ok(1..)) || heard.send(line).is_err() {
            return;
        }
    }
}
