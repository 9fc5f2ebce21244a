//! A headless browser, driven by the DevTools protocol over two pipes: no port, no further crate.
//!
//! A browser that is started with `--remote-debugging-pipe` reads commands from its descriptor 3 and answers on 4, each a JSON
//! text that a zero byte ends. A shell puts our pipes there.

use std::collections::VecDeque;
use std::env;
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// Names under which browsers are installed.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// How long a page may take to do what is waited for.
const PATIENCE: Duration = Duration::from_secs(30);

/// A browser with one page.
pub struct Browser {
    child: Child,
    commands: ChildStdin,
    answers: BufReader<ChildStdout>,
    next: u64,
    session: Option<String>,
    events: VecDeque<Value>,
    _profile: tempfile::TempDir,
}

/// The browser on this machine.
fn found() -> Option<PathBuf> {
    if let Some(named) = env::var_os("ZHUYI_BROWSER") {
        return Some(named.into());
    }
    let path = env::var_os("PATH")?;
    let folders: Vec<PathBuf> = env::split_paths(&path).collect();
    let places = NAMES
        .iter()
        .flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    places.into_iter().find(|place| place.is_file())
}

impl Browser {
    /// A browser with an empty page; none where none is installed.
    pub fn start() -> Option<Self> {
        let Some(program) = found() else {
            // Past what the tests' harness captures, which shows nothing of a test that passes.
            let told = format!("skipped: no browser found ({})\n", NAMES.join(", "));
            io::stderr().write_all(told.as_bytes()).unwrap();
            return None;
        };
        let profile = tempfile::tempdir().unwrap();
        // Descriptors 3 and 4 for the protocol; what the browser prints is of no use.
        let line = r#"exec "$0" "$@" 3<&0 4>&1 >/dev/null 2>/dev/null </dev/null"#;
        let mut child = Command::new("sh")
            .args(["-c", line])
            .arg(program)
            .args([
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--disable-dev-shm-usage",
                "--no-first-run",
                "--remote-debugging-pipe",
                "--window-size=1280,900",
            ])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg("about:blank")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut browser = Self {
            commands: child.stdin.take().unwrap(),
            answers: BufReader::new(child.stdout.take().unwrap()),
            child,
            next: 0,
            session: None,
            events: VecDeque::new(),
            _profile: profile,
        };
        let target = browser.call("Target.createTarget", &json!({"url": "about:blank"}));
        let attach = json!({"targetId": target["targetId"], "flatten": true});
        let attached = browser.call("Target.attachToTarget", &attach);
        browser.session = Some(attached["sessionId"].as_str().unwrap().to_string());
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.call(&format!("{domain}.enable"), &json!({}));
        }
        Some(browser)
    }

    /// One command and its answer.
    pub fn call(&mut self, method: &str, params: &Value) -> Value {
        let answer = self.answer(method, params);
        answer.unwrap_or_else(|error| panic!("{method}: {error}"))
    }

    /// One command and its answer, or why there is none.
    fn answer(&mut self, method: &str, params: &Value) -> Result<Value, Value> {
        self.next += 1;
        let mut command = json!({"id": self.next, "method": method, "params": params});
        if let Some(session) = &self.session {
            command["sessionId"] = json!(session);
        }
        let mut bytes = command.to_string().into_bytes();
        bytes.push(0);
        self.commands.write_all(&bytes).unwrap();
        loop {
            let mut bytes = Vec::new();
            self.answers.read_until(0, &mut bytes).unwrap();
            assert_eq!(bytes.pop(), Some(0), "the browser is gone at {method}");
            let message: Value = serde_json::from_slice(&bytes).unwrap();
            if message["id"] == self.next {
                return match &message["error"] {
                    Value::Null => Ok(message["result"].clone()),
                    error => Err(error.clone()),
                };
            }
            self.events.push_back(message);
        }
    }

    /// Opens a file and waits until its report is drawn.
    pub fn open(&mut self, file: &Path) {
        self.open_at(file, "");
    }

    /// The same with a part of the address behind the file's.
    pub fn open_at(&mut self, file: &Path, part: &str) {
        let url = format!("file://{}{part}", file.display());
        self.call("Page.navigate", &json!({"url": url}));
        self.wait("document.readyState === 'complete' && document.getElementById('time')?.textContent !== ''");
    }

    /// The value of an expression on the page.
    pub fn value(&mut self, expression: &str) -> Value {
        let params = json!({"expression": expression, "returnByValue": true, "awaitPromise": true});
        let answer = self.call("Runtime.evaluate", &params);
        let thrown = &answer["exceptionDetails"];
        assert!(thrown.is_null(), "{expression}: {thrown}");
        answer["result"]["value"].clone()
    }

    /// The text of the first element that a selector finds.
    pub fn text(&mut self, selector: &str) -> String {
        let selector = json!(selector);
        let text = self.value(&format!("document.querySelector({selector}).textContent"));
        text.as_str().unwrap().to_string()
    }

    /// The number at the start of that text.
    pub fn number(&mut self, selector: &str) -> f64 {
        let text = self.text(selector);
        let number = text.split_whitespace().next().unwrap_or("").parse();
        number.unwrap_or_else(|_| panic!("no number in {selector}: {text:?}"))
    }

    /// Waits until an expression holds. While a page makes way for another, none does.
    pub fn wait(&mut self, expression: &str) {
        let begun = Instant::now();
        let params = json!({"expression": format!("Boolean({expression})"), "returnByValue": true});
        loop {
            let answer = self.answer("Runtime.evaluate", &params);
            if answer.is_ok_and(|answer| answer["result"]["value"] == json!(true)) {
                return;
            }
            let in_vain = begun.elapsed() > PATIENCE;
            assert!(!in_vain, "waited in vain for {expression}");
            sleep(Duration::from_millis(20));
        }
    }

    /// Presses a key, as a keyboard does.
    pub fn key(&mut self, key: &str, code: &str) {
        for kind in ["keyDown", "keyUp"] {
            let params = json!({"type": kind, "key": key, "code": code});
            self.call("Input.dispatchKeyEvent", &params);
        }
    }

    /// Clicks the middle of the first element that a selector finds, as a mouse does.
    pub fn click(&mut self, selector: &str) {
        self.click_at(selector, 0.5);
    }

    /// Clicks an element at a share of its width.
    pub fn click_at(&mut self, selector: &str, share: f64) {
        let selector = json!(selector);
        let place = self.value(&format!(
            "(() => {{ const found = document.querySelector({selector}); found.scrollIntoView({{block: 'center'}}); \
             const box = found.getBoundingClientRect(); \
             return [box.left + {share} * box.width, box.top + box.height / 2]; }})()"
        ));
        for kind in ["mousePressed", "mouseReleased"] {
            let params = json!({"type": kind, "x": place[0], "y": place[1], "button": "left", "buttons": 1, "clickCount": 1});
            self.call("Input.dispatchMouseEvent", &params);
        }
    }

    /// Moves a slider to a value, as a hand does: with the event that the page listens for.
    pub fn slide(&mut self, selector: &str, value: u32) {
        let selector = json!(selector);
        self.value(&format!(
            "(() => {{ const slider = document.querySelector({selector}); slider.value = {value}; \
             slider.dispatchEvent(new Event('input', {{bubbles: true}})); }})()"
        ));
    }

    /// Errors of the page so far: exceptions, what it wrote to the console as error or warning, what the browser logged.
    pub fn errors(&mut self) -> Vec<String> {
        // What has happened is told by the time that a later command is answered.
        self.value("1");
        let wrong = |event: &&Value| match event["method"].as_str() {
            Some("Runtime.exceptionThrown") => true,
            Some("Runtime.consoleAPICalled") => {
                event["params"]["type"] == "error" || event["params"]["type"] == "warning"
            }
            Some("Log.entryAdded") => event["params"]["entry"]["level"] == "error",
            _ => false,
        };
        self.events
            .iter()
            .filter(wrong)
            .map(Value::to_string)
            .collect()
    }

    /// Addresses of all that the page asked for.
    pub fn requests(&mut self) -> Vec<String> {
        self.value("1");
        let requests = self
            .events
            .iter()
            .filter(|event| event["method"] == "Network.requestWillBeSent");
        requests
            .map(|event| {
                event["params"]["request"]["url"]
                    .as_str()
                    .unwrap()
                    .to_string()
            })
            .collect()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // It may be gone already; then there is nothing to end.
        let _gone = self.child.kill();
        let _gone = self.child.wait();
    }
}
