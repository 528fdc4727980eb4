//! Who may not ask, and what is not answered.

use std::io::Write;

use super::{Studio, read};

#[test]
fn without_the_token_nothing_is_answered() {
    let studio = Studio::open(&[]);
    for path in ["/", "/studio.js", "/api/start", "/api/runs", "/runs/a/report.html"] {
        assert_eq!(studio.with(&format!("GET {path}"), &[], "").status, 403, "{path}");
        let wrong = format!("GET {path}?token={}", "0".repeat(studio.token.len()));
        assert_eq!(studio.with(&wrong, &[], "").status, 403, "{path}");
    }
    assert_eq!(studio.token.len(), 32, "128 bits");
    assert_eq!(studio.with(&format!("GET /?token={}", studio.token), &[], "").status, 200);
    assert_eq!(studio.get("/api/start").status, 200);
}

#[test]
fn another_origin_or_host_is_refused_with_the_token_too() {
    let studio = Studio::open(&[]);
    let token = ("X-Splashdown-Token", studio.token.as_str());
    let own = format!("http://{}", studio.host);
    let status = |header: (&str, &str)| studio.with("GET /api/start", &[token, header], "").status;
    assert_eq!(status(("Origin", &own)), 200);
    assert_eq!(status(("Sec-Fetch-Site", "same-origin")), 200);
    for header in [
        ("Origin", "http://example.org"),
        ("Origin", "null"),
        ("Origin", "http://127.0.0.1:1"),
        ("Sec-Fetch-Site", "cross-site"),
    ] {
        assert_eq!(status(header), 403, "{header:?}");
    }
    for host in ["example.org", "127.0.0.1", "attacker.example:80"] {
        let request =
            format!("GET /api/start HTTP/1.1\r\nHost: {host}\r\nX-Splashdown-Token: {}\r\n\r\n", studio.token);
        assert_eq!(studio.raw(&request).status, 403, "{host}");
    }
    let without = format!("GET /api/start HTTP/1.1\r\nX-Splashdown-Token: {}\r\n\r\n", studio.token);
    assert_eq!(studio.raw(&without).status, 400, "HTTP/1.1 asks for a host");
}

#[test]
fn only_this_machine_can_connect_and_no_answer_invites_other_pages() {
    let studio = Studio::open(&[]);
    assert!(studio.host.starts_with("127.0.0.1:"));
    for path in ["/", "/studio.js", "/api/start", "/api/nothing"] {
        let head = studio.get(path).head.to_lowercase();
        assert!(!head.contains("access-control"), "{head}");
        for line in [
            "content-security-policy: default-src 'none'",
            "x-content-type-options: nosniff",
            "referrer-policy: no-referrer",
            "cross-origin-resource-policy: same-origin",
            "cross-origin-opener-policy: same-origin",
            "cache-control: no-store",
        ] {
            assert!(head.contains(line), "{path}: {line}: {head}");
        }
        assert!(!head.contains("http:") && !head.contains("https:"), "no outside source: {head}");
    }
}

#[test]
fn paths_outside_the_runs_of_the_studio_are_not_there() {
    let studio = Studio::open(&[]);
    let folder = studio.folder.path();
    std::fs::create_dir_all(folder.join("runs/own")).expect("a folder");
    std::fs::create_dir_all(folder.join("secret")).expect("a folder");
    for place in ["runs/own", "secret", "."] {
        std::fs::write(folder.join(place).join("report.html"), "a page").expect("a file");
    }
    assert_eq!(studio.get("/runs/own/report.html").body, "a page");
    #[cfg(unix)]
    std::os::unix::fs::symlink(folder.join("secret"), folder.join("runs/link")).expect("a link");
    for path in [
        "/runs/../report.html",
        "/runs/%2e%2e/report.html",
        "/runs/..%2fsecret/report.html",
        "/runs/own%2f..%2f..%2fsecret/report.html",
        "/runs/own/..%2freport.html",
        "/runs/own/%2fetc%2fpasswd",
        "/runs/link/report.html",
        "/runs/.hidden/report.html",
        "/runs/own%00/report.html",
        "/api/compare?run=own&run=..%2fsecret",
        "/api/runs/..%2fsecret/answer",
    ] {
        let answer = studio.get(path);
        assert!(answer.status == 404 && !answer.body.contains("a page"), "{path}: {} {}", answer.status, answer.body);
    }
}

#[test]
fn a_body_of_100_megabytes_is_refused_before_it_is_sent() {
    let studio = Studio::open(&[]);
    let mut stream = studio.connect();
    let head = format!(
        "POST /api/scene HTTP/1.1\r\nHost: {}\r\nX-Splashdown-Token: {}\r\nContent-Length: 104857600\r\n\r\n{{\"text\":",
        studio.host, studio.token
    );
    stream.write_all(head.as_bytes()).expect("the studio reads the head");
    // the other 100 MB are never sent
    let answer = read(&mut stream);
    assert_eq!(answer.status, 413, "{}", answer.body);
    let large = "x".repeat(1 << 21);
    let sent = studio.with("POST /api/scene", &[("X-Splashdown-Token", &studio.token)], &large);
    assert_eq!(sent.status, 413);
}

#[test]
fn a_body_in_chunks_has_the_same_limit() {
    let studio = Studio::open(&[]);
    let sent = |chunk: &str, count: usize| {
        let chunks = format!("{:x}\r\n{chunk}\r\n", chunk.len()).repeat(count);
        studio.raw(&format!(
            "POST /api/scene HTTP/1.1\r\nHost: {}\r\nX-Splashdown-Token: {}\r\nTransfer-Encoding: chunked\r\n\r\n{chunks}0\r\n\r\n",
            studio.host, studio.token
        ))
    };
    assert_eq!(sent("{\"text\": \"\"}", 1).status, 200);
    assert_eq!(sent(&"x".repeat(1 << 16), 32).status, 413);
}

#[test]
fn many_connections_without_a_whole_request_do_not_stop_the_page() {
    let studio = Studio::open(&[]);
    let mut idle: Vec<_> = (0..100).map(|_| studio.connect()).collect();
    for stream in idle.iter_mut().step_by(2) {
        stream.write_all(b"GET / HTTP/1.1\r\nHost: ").expect("the studio reads");
    }
    assert_eq!(studio.get("/api/start").status, 200);
}

#[test]
fn what_is_no_request_is_refused_and_the_studio_goes_on() {
    let studio = Studio::open(&[]);
    assert_eq!(studio.raw("nonsense\r\n\r\n").status, 400);
    let many = format!("GET / HTTP/1.1\r\nHost: {}\r\nX-Long: {}\r\n\r\n", studio.host, "y".repeat(9 << 10));
    assert_eq!(studio.raw(&many).status, 400);
    let token = [("X-Splashdown-Token", studio.token.as_str())];
    assert_eq!(studio.with("POST /api/scene", &token, "{\"words\": 1}").status, 400);
    assert_eq!(studio.with("DELETE /api/runs", &token, "").status, 405);
    assert_eq!(studio.get("/api/nothing").status, 404);
    assert_eq!(studio.get("/api/start").status, 200);
}
